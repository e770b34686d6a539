// Puts a data block (docs/formats/report-data.md) into the template, as `koshi report` does.

const EMPTY_BLOCK = '<script type="application/json" id="koshi-data"></script>';

/**
 * @param {string} template the built page; holds the empty block exactly once
 * @param {object} data     the data block
 * @returns {string} the finished page
 */
export function fill(template, data) {
  const parts = template.split(EMPTY_BLOCK);
  if (parts.length !== 2) throw new Error(`the template holds ${parts.length - 1} empty data blocks, not one`);
  // "<" cannot stand in the block, or a text in the data could end the script element.
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  return parts[0] + EMPTY_BLOCK.replace("></", `>${json}</`) + parts[1];
}
