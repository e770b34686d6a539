// The three-dimensional picture: surface, lattice lines and undeformed outline, drawn by vtk.js.
import "@kitware/vtk.js/Rendering/OpenGL/Actor";
import "@kitware/vtk.js/Rendering/OpenGL/Camera";
import "@kitware/vtk.js/Rendering/OpenGL/PolyDataMapper";
import "@kitware/vtk.js/Rendering/OpenGL/Renderer";
import "@kitware/vtk.js/Rendering/OpenGL/Texture";
import vtkCellArray from "@kitware/vtk.js/Common/Core/CellArray";
import vtkDataArray from "@kitware/vtk.js/Common/Core/DataArray";
import vtkPolyData from "@kitware/vtk.js/Common/DataModel/PolyData";
import vtkInteractorStyleTrackballCamera from "@kitware/vtk.js/Interaction/Style/InteractorStyleTrackballCamera";
import vtkActor from "@kitware/vtk.js/Rendering/Core/Actor";
import vtkCellPicker from "@kitware/vtk.js/Rendering/Core/CellPicker";
import vtkColorTransferFunction from "@kitware/vtk.js/Rendering/Core/ColorTransferFunction";
import vtkMapper from "@kitware/vtk.js/Rendering/Core/Mapper";
import vtkRenderer from "@kitware/vtk.js/Rendering/Core/Renderer";
import vtkRenderWindow from "@kitware/vtk.js/Rendering/Core/RenderWindow";
import vtkRenderWindowInteractor from "@kitware/vtk.js/Rendering/Core/RenderWindowInteractor";
import vtkOpenGLRenderWindow from "@kitware/vtk.js/Rendering/OpenGL/RenderWindow";
import { components, steps } from "./colours.js";

// Directions from which the standard views look, and what is up in them.
const VIEWS = {
  oblique: { from: [1, -1.1, 0.65], up: [0, 0, 1] },
  x: { from: [1, 0, 0], up: [0, 0, 1] },
  y: { from: [0, -1, 0], up: [0, 0, 1] },
  z: { from: [0, 0, 1], up: [0, 1, 0] },
};

const FIT_MARGIN = 1.12;
const COLOUR_STEPS = 129;

/** Whether this browser can draw the body at all. */
export function canDraw() {
  return Boolean(document.createElement("canvas").getContext("webgl2"));
}

export class Scene {
  /** @param {HTMLElement} container filled by the picture; @param {boolean} interactive mouse and touch turn the body */
  constructor(container, interactive) {
    this.container = container;
    this.renderer = vtkRenderer.newInstance();
    this.renderer.setBackground(0, 0, 0, 0);  // see-through: the page's colour shows
    this.window = vtkRenderWindow.newInstance();
    this.window.addRenderer(this.renderer);
    this.gl = vtkOpenGLRenderWindow.newInstance();
    this.gl.setContainer(container);
    this.window.addView(this.gl);
    this.camera = this.renderer.getActiveCamera();
    this.camera.setParallelProjection(true);

    this.surface = layer(this.renderer);
    // Mostly ambient light: colours must stay those of the colour bar, shading only tells the faces apart.
    this.surface.actor.getProperty().set({ ambient: 0.72, diffuse: 0.28, specular: 0 });
    this.surface.actor.getProperty().setInterpolationToFlat();
    this.surface.mapper.setInterpolateScalarsBeforeMapping(true);
    // The surface is drawn a little farther away, so that lines upon it are not swallowed.
    this.surface.mapper.setResolveCoincidentTopologyToPolygonOffset();
    this.surface.mapper.setRelativeCoincidentTopologyPolygonOffsetParameters(1, 1);
    this.lines = layer(this.renderer);
    this.outline = layer(this.renderer);
    for (const { actor } of [this.lines, this.outline]) actor.getProperty().setLighting(false);

    if (interactive) {
      this.interactor = vtkRenderWindowInteractor.newInstance();
      this.interactor.setView(this.gl);
      this.interactor.initialize();
      this.interactor.setInteractorStyle(vtkInteractorStyleTrackballCamera.newInstance());
      this.interactor.bindEvents(container);
    }
    this.resize();
  }

  /** Matches the drawing buffer to the container's size. */
  resize() {
    const ratio = window.devicePixelRatio || 1;
    const { width, height } = this.container.getBoundingClientRect();
    this.gl.setSize(Math.max(1, Math.floor(width * ratio)), Math.max(1, Math.floor(height * ratio)));
  }

  /**
   * @param {Float32Array} points  deformed positions, x, y, z by point
   * @param {Int32Array} quads     four point indices each
   * @param {Int32Array|null} pairs lines upon the surface
   */
  setBody(points, quads, pairs) {
    this.surface.data.getPoints().setData(points, 3);
    this.surface.data.setPolys(cells(quads, 4));
    this.lines.data.getPoints().setData(points, 3);
    this.lines.data.setLines(cells(pairs ?? [], 2));
    for (const { data } of [this.surface, this.lines]) data.modified();
  }

  setPositions(points) {
    for (const { data } of [this.surface, this.lines]) {
      data.getPoints().setData(points, 3);
      data.getPoints().modified();
      data.modified();
    }
  }

  /** The undeformed body's edges; null points hide them. */
  setOutline(points, pairs) {
    this.outline.data.getPoints().setData(points ?? new Float32Array(0), 3);
    this.outline.data.setLines(cells(points ? pairs : [], 2));
    this.outline.data.modified();
  }

  /**
   * Colours the surface.
   * @param {Float32Array} values a value per point, or per quad when `perQuad`
   * @param {object} map          {colour, min, max}, or {categories: [[code, css colour], …]}
   */
  setColours(values, perQuad, map) {
    const { data, mapper } = this.surface;
    const scalars = vtkDataArray.newInstance({ name: "shown", values, numberOfComponents: 1 });
    data.getPointData().setScalars(perQuad ? null : scalars);
    data.getCellData().setScalars(perQuad ? scalars : null);
    if (perQuad) mapper.setScalarModeToUseCellData();
    else mapper.setScalarModeToUsePointData();
    const table = map.categories ? categoryTable(map.categories) : continuousTable(map);
    mapper.setLookupTable(table);
    mapper.setUseLookupTableScalarRange(true);
    mapper.setInterpolateScalarsBeforeMapping(!perQuad);
    data.modified();
  }

  /** @param {string} line @param {string} outline CSS colours */
  setLineColours(line, outline) {
    this.lines.actor.getProperty().setColor(...components(line));
    this.lines.actor.getProperty().setOpacity(0.55);
    this.outline.actor.getProperty().setOpacity(0.7);
    this.outline.actor.getProperty().setColor(...components(outline));
  }

  /** Looks at the whole body from a standard direction. */
  view(name) {
    const { from, up } = VIEWS[name];
    const focus = this.camera.getFocalPoint();
    this.camera.setPosition(...focus.map((value, axis) => value + from[axis]));
    this.camera.setViewUp(...up);
    this.camera.orthogonalizeViewUp();
    this.renderer.resetCamera();
    this.fit();
  }

  // Zooms so that the visible body's bounding box fills the picture, whatever its width to height.
  fit() {
    const box = this.renderer.computeVisiblePropBounds();
    const m = this.camera.getViewMatrix();
    const half = [0, 1].map((row) => [0, 1, 2].reduce((sum, axis) =>
      sum + (Math.abs(m[4 * row + axis]) * (box[2 * axis + 1] - box[2 * axis])) / 2, 0));
    const [width, height] = this.gl.getSize();
    this.camera.setParallelScale(FIT_MARGIN * Math.max(half[1], (half[0] * height) / width));
  }

  /** Turns the body by angles in degrees: right and up. */
  rotate(right, up) {
    this.camera.azimuth(-right);
    this.camera.elevation(-up);
    this.camera.orthogonalizeViewUp();
    this.renderer.resetCameraClippingRange();
  }

  zoom(factor) {
    this.camera.zoom(factor);
    this.renderer.resetCameraClippingRange();
  }

  render() {
    this.renderer.resetCameraClippingRange();
    this.window.render();
  }

  /** Whether the reader looks along an axis (positive) or against it (negative). */
  looksAlong(axis) {
    return this.camera.getDirectionOfProjection()[axis] ?? 0;
  }

  /** Screen directions (right, up) of the body's three axes, each of length <= 1. */
  axes() {
    const m = this.camera.getViewMatrix();
    return [0, 1, 2].map((axis) => [m[axis], m[4 + axis]]);
  }

  /** The picture as a PNG data address; drawn afresh, because the browser clears the buffer after showing it. */
  capture() {
    this.render();
    return this.gl.getCanvas().toDataURL("image/png");
  }

  /** The quad under a place of the container [CSS pixels] and the point hit, or null. */
  pick(x, y) {
    const ratio = window.devicePixelRatio || 1;
    const picker = vtkCellPicker.newInstance();
    picker.setPickFromList(true);
    picker.initializePickList();
    picker.addPickList(this.surface.actor);
    picker.pick([x * ratio, this.gl.getSize()[1] - y * ratio, 0], this.renderer);
    const quad = picker.getCellId();
    return quad < 0 ? null : { quad, position: picker.getPickPosition() };
  }

  delete() {
    this.gl.setContainer(null);
    this.window.delete();
    this.gl.delete();
  }
}

// A set of polygons or lines with its mapper and actor.
function layer(renderer) {
  const data = vtkPolyData.newInstance();
  const mapper = vtkMapper.newInstance();
  mapper.setInputData(data);
  const actor = vtkActor.newInstance();
  actor.setMapper(mapper);
  renderer.addActor(actor);
  return { data, mapper, actor };
}

function cells(indices, size) {
  const count = indices.length / size;
  const values = new Uint32Array(count * (size + 1));
  for (let cell = 0; cell < count; ++cell) {
    values[cell * (size + 1)] = size;
    for (let i = 0; i < size; ++i) values[cell * (size + 1) + 1 + i] = indices[cell * size + i];
  }
  return vtkCellArray.newInstance({ values });
}

function continuousTable(map) {
  const table = vtkColorTransferFunction.newInstance();
  // A constant field still needs a range to lie in.
  const width = map.max - map.min || Math.abs(map.max) || 1;
  steps(map, COLOUR_STEPS).forEach((rgb, i) => table.addRGBPoint(map.min + (width * i) / (COLOUR_STEPS - 1), ...rgb));
  return table;
}

function categoryTable(categories) {
  const table = vtkColorTransferFunction.newInstance();
  for (const [code, colour] of categories) {
    table.addRGBPoint(code - 0.499, ...components(colour));
    table.addRGBPoint(code + 0.499, ...components(colour));
  }
  return table;
}
