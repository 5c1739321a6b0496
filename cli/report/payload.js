// Reads the numbers the page carries: base64, deflate, planes of bytes, differences of neighbours.
"use strict";

// What no page survives is told on it.
function fail(error) {
  const text = String(error && error.message || error);
  document.body.dataset.error = text;
  document.getElementById("lead").textContent = `This report could not be shown: ${text}`;
}
addEventListener("error", event => fail(event.error || event.message));
addEventListener("unhandledrejection", event => fail(event.reason));

async function inflated(id) {
  const text = document.getElementById(id).textContent;
  const packed = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function decoded(id, ArrayType, stride) {
  const bytes = await inflated(id);
  const width = ArrayType.BYTES_PER_ELEMENT, count = bytes.length / width;
  const values = new ArrayType(count);
  for (let i = 0; i < count; ++i) {
    let difference = 0;
    for (let plane = width - 1; plane >= 0; --plane) {
      difference = difference << 8 | bytes[plane * count + i];
    }
    values[i] = difference + (i < stride ? 0 : values[i - stride]);  // wraps as it was written
  }
  return values;
}

const shorts = (id, stride) => decoded(id, Uint16Array, stride);
const integers = (id, stride) => decoded(id, Int32Array, stride);
const floats = async id => new Float32Array((await decoded(id, Uint32Array, 1)).buffer);

