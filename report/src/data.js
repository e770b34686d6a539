// Reading the data block that `koshi report` puts into the page: docs/formats/report-data.md.
import { unzlibSync } from "fflate";

const FORMAT = "koshi-report/1";
const TYPES = { f4: Float32Array, f8: Float64Array, i4: Int32Array, u1: Uint8Array };

/** The data block of this page, or null when the template has not been filled. */
export function readBlock() {
  const text = document.getElementById("koshi-data").textContent.trim();
  if (!text) return null;
  const data = JSON.parse(text);
  if (data.format !== FORMAT) throw new Error(`the data are "${data.format}", this page reads "${FORMAT}"`);
  return data;
}

/**
 * Numbers of an Array of the format: a plain JSON list (null = not a number) or {dtype, encoding, data}; those decoded
 * before stay as they are.
 * @returns {Float32Array|Float64Array|Int32Array|Uint8Array}
 */
export function decode(array) {
  if (ArrayBuffer.isView(array)) return array;
  if (Array.isArray(array)) return Float64Array.from(array, (value) => value ?? NaN);
  const type = TYPES[array.dtype];
  if (!type) throw new Error(`unknown dtype "${array.dtype}"`);
  let bytes = bytesOfBase64(array.data);
  if (array.encoding === "zlib+base64") bytes = unzlibSync(bytes);
  else if (array.encoding !== "base64") throw new Error(`unknown encoding "${array.encoding}"`);
  // Typed arrays read the machine's byte order; every machine a browser runs on today is little-endian, as the data.
  return new type(bytes.buffer, bytes.byteOffset, bytes.byteLength / type.BYTES_PER_ELEMENT);
}

function bytesOfBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
