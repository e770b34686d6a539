// Arrays of the data format from typed arrays; the reverse of `decode` in src/data.js.
import { deflateSync } from "node:zlib";

const TYPES = new Map([[Float32Array, "f4"], [Float64Array, "f8"], [Int32Array, "i4"], [Uint8Array, "u1"]]);

/** {dtype, encoding, data} of a typed array, deflated unless `plain`. */
export function encode(values, plain = false) {
  const bytes = Buffer.from(values.buffer, values.byteOffset, values.byteLength);
  const data = (plain ? bytes : deflateSync(bytes)).toString("base64");
  return { dtype: TYPES.get(values.constructor), encoding: plain ? "base64" : "zlib+base64", data };
}
