// Decodes the data embedded in the page: base64, deflate, byte planes, differences of neighbours.
"use strict";

// Shows fatal errors on the page.
function fail(error) {
  const text = String(error && error.message || error);
  document.body.dataset.error = text;
  document.getElementById("lead").textContent = `This report could not be shown: ${text}`;
}
addEventListener("error", event => fail(event.error || event.message));
addEventListener("unhandledrejection", event => fail(event.reason));

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

// The text of a section of the data: in this page, or where live.js keeps it.
let sectionText = id => document.getElementById(id).textContent;

async function inflated(id) {
  const stream = new Blob([fromBase64(sectionText(id))]).stream().pipeThrough(new DecompressionStream("deflate"));
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
    values[i] = difference + (i < stride ? 0 : values[i - stride]);  // wraps around as when encoded
  }
  return values;
}

const shorts = (id, stride) => decoded(id, Uint16Array, stride);
const integers = (id, stride) => decoded(id, Int32Array, stride);
const floats = async id => new Float32Array((await decoded(id, Uint32Array, 1)).buffer);

