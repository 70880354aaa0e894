// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors

// A sheet (sheet.js) as a PDF of one page, with the standard font Helvetica.

const POINTS_PER_mm = 72 / 25.4;
const WIDTH_OF_LETTER = 0.5;  // of Helvetica, in sizes: near enough to centre a measure

/// picture: a canvas for sheet.image, or null. Bytes.
export async function pdfBytes(sheet, picture) {
  const size = sheet.size_mm.map((side) => (side * POINTS_PER_mm).toFixed(2)).join(" ");
  const resources = `/Font << /F 5 0 R >>${picture ? " /XObject << /I 6 0 R >>" : ""}`;
  const objects = [
    ["<< /Type /Catalog /Pages 2 0 R >>"],
    ["<< /Type /Pages /Kids [3 0 R] /Count 1 >>"],
    [`<< /Type /Page /Parent 2 0 R /MediaBox [0 0 ${size}] /Contents 4 0 R /Resources << ${resources} >> >>`],
    await stream("", new TextEncoder().encode(drawing(sheet, picture !== null))),
    ["<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>"],
  ];
  if (picture) objects.push(await image(picture));
  return assemble(objects);
}

async function deflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function stream(entries, bytes) {
  const content = await deflated(bytes);
  return [`<< ${entries} /Filter /FlateDecode /Length ${content.length} >>\nstream\n`, content, "\nendstream"];
}

function image(picture) {
  const {width, height} = picture;
  const rgba = picture.getContext("2d").getImageData(0, 0, width, height).data;
  const rgb = new Uint8Array(width * height * 3);
  for (let i = 0; i < width * height; ++i) rgb.set(rgba.subarray(4 * i, 4 * i + 3), 3 * i);
  return stream(`/Type /XObject /Subtype /Image /Width ${width} /Height ${height} /ColorSpace /DeviceRGB /BitsPerComponent 8`, rgb);
}

function drawing(sheet, hasPicture) {
  const n = (number) => number.toFixed(3);
  const parts = [`${n(POINTS_PER_mm)} 0 0 ${n(POINTS_PER_mm)} 0 0 cm 1 j`];
  if (hasPicture) {
    const {low, high} = sheet.image;
    parts.push(`q ${n(high[0] - low[0])} 0 0 ${n(high[1] - low[1])} ${n(low[0])} ${n(low[1])} cm /I Do Q`);
  }
  for (const {points, colour, width_mm} of sheet.lines) {
    const path = points.map(([x, y], i) => `${n(x)} ${n(y)} ${i === 0 ? "m" : "l"}`).join(" ");
    parts.push(`${rgbOf(colour)} RG ${n(width_mm)} w ${path} S`);
  }
  for (const text of sheet.texts) parts.push(textDrawing(text, n));
  return parts.join("\n");
}

function textDrawing({at, text, size_mm, anchor, turned}, n) {
  const back_mm = anchor === "middle" ? text.length * size_mm * WIDTH_OF_LETTER / 2 : 0;
  const matrix = turned ? ["0 1 -1 0", at[0], at[1] - back_mm] : ["1 0 0 1", at[0] - back_mm, at[1]];
  const literal = text.replace(/[^\x20-\x7e]/g, "?").replace(/[\\()]/g, "\\$&");
  return `BT /F ${n(size_mm)} Tf ${matrix[0]} ${n(matrix[1])} ${n(matrix[2])} Tm (${literal}) Tj ET`;
}

function rgbOf(colour) {
  return [1, 3, 5].map((at) => (parseInt(colour.slice(at, at + 2), 16) / 255).toFixed(3)).join(" ");
}

/// The file: objects numbered from 1, each a list of texts and bytes, and where each begins.
function assemble(objects) {
  const [parts, offsets] = [[], []];
  let length = 0;
  const add = (part) => {
    const bytes = typeof part === "string" ? new TextEncoder().encode(part) : part;
    parts.push(bytes);
    length += bytes.length;
  };
  add("%PDF-1.5\n");
  objects.forEach((object, i) => {
    offsets.push(length);
    [`${i + 1} 0 obj\n`, ...object, "\nendobj\n"].forEach(add);
  });
  const start = length;
  const rows = offsets.map((offset) => `${String(offset).padStart(10, "0")} 00000 n \n`).join("");
  add(`xref\n0 ${objects.length + 1}\n0000000000 65535 f \n${rows}trailer\n<< /Size ${objects.length + 1} /Root 1 0 R >>\nstartxref\n${start}\n%%EOF\n`);
  const file = new Uint8Array(length);
  parts.reduce((at, part) => (file.set(part, at), at + part.length), 0);
  return file;
}
