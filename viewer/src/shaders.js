// SPDX-License-Identifier: BSD-3-Clause
// The programs of the two draw calls: triangles, and lines and points. Neither has vertex attributes: everything is fetched from
// textures by gl_VertexID, so that a million triangles take 16 bytes each, and a choice of them is a list of numbers.

const HEAD = `precision highp float; precision highp int; precision highp sampler2D; precision highp usampler2D;\n`;
const FETCH = `
ivec2 place(uint i) { return ivec2(i & 2047u, i >> 11u); }  // of an item in a texture
`;

/** gl_VertexID is 6·triangle + 3·side + corner. */
export const triangleVertex = HEAD + `
uniform mat4 modelViewMatrix, projectionMatrix;
uniform sampler2D positions;   // of vertices
uniform usampler2D triangles;  // three vertices, whose highest bits are the sides that are edges; the cell on side 0
uniform usampler2D others;     // the cell on side 1
uniform sampler2D scalars;     // of cells or vertices, 0 ... 1 within the range; < -1 for none
uniform bool ofVertices;
out vec3 barycentric;
out vec3 place3;
out float smoothed;
flat out float scalar;
flat out uint edges, cell, triangle;
${FETCH}
void main() {
  uint id = uint(gl_VertexID);
  triangle = id / 3u;
  uint corner = id % 3u;
  uvec4 it = texelFetch(triangles, place(triangle >> 1u), 0);
  uint vertex = it[corner] & 0x7fffffffu;
  scalar = smoothed = -3.0;
  cell = edges = 0u;
  if (corner == 2u) {  // flat numbers are those of the last corner
    cell = (triangle & 1u) == 0u ? it.w : texelFetch(others, place(triangle >> 1u), 0).r;
    edges = (it.x >> 31u) | (it.y >> 31u << 1u) | (it.z >> 31u << 2u);
    if (!ofVertices) scalar = texelFetch(scalars, place(cell), 0).r;
  }
  if (ofVertices) smoothed = texelFetch(scalars, place(vertex), 0).r;
  barycentric = vec3(corner == 0u, corner == 1u, corner == 2u);
  vec4 seen = modelViewMatrix * vec4(texelFetch(positions, place(vertex), 0).xyz, 1.0);
  place3 = seen.xyz;
  gl_Position = projectionMatrix * seen;
}`;

export const triangleFragment = HEAD + `
uniform sampler2D colors;
uniform vec3 plain, edgeColor, missing;
uniform float opacity, edgeWidth, light;
uniform bool colored, ofVertices;
uniform uint hovered;
in vec3 barycentric;
in vec3 place3;
in float smoothed;
flat in float scalar;
flat in uint edges, cell, triangle;
layout(location = 0) out vec4 color;
void main() {
  vec3 base = plain;
  float value = ofVertices ? smoothed : scalar;
  if (colored) base = value < -1.0 ? missing : texture(colors, vec2(clamp(value, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
  if (cell == hovered) base = mix(base, vec3(1.0), 0.35);
  // A lamp beside the camera; of flat faces the normal is known from the picture itself.
  vec3 normal = normalize(cross(dFdx(place3), dFdy(place3)));
  float facing = abs(dot(normal, normalize(vec3(0.25, 0.45, 1.0))));
  base *= mix(1.0, 0.5 + 0.56 * facing, light);
  // The distance from each side in pixels. Where triangles are smaller than lines, there are no lines.
  vec3 perPixel = max(fwidth(barycentric), vec3(1e-6));
  vec3 away = barycentric / perPixel;
  vec3 isEdge = vec3(edges & 1u, (edges >> 1u) & 1u, (edges >> 2u) & 1u);
  away = mix(vec3(1e6), away, isEdge);
  float nearest = min(away.x, min(away.y, away.z));
  float height = 1.0 / max(perPixel.x, max(perPixel.y, perPixel.z));
  float line = (1.0 - smoothstep(edgeWidth - 0.5, edgeWidth + 0.5, nearest)) * smoothstep(1.5, 14.0, height) * min(edgeWidth * 2.0, 1.0);
  float covered = mix(opacity, max(opacity, 0.75), line);
  color = vec4(mix(base, edgeColor, line * (opacity < 1.0 ? 0.35 : 0.62)), covered);
}`;

/** The number of what is under a pixel: triangle · 2 + side + 1, lowest byte first. */
export const pickFragment = HEAD + `
flat in uint triangle;
layout(location = 0) out vec4 color;
void main() {
  uint name = triangle + 1u;
  color = vec4(name & 255u, (name >> 8u) & 255u, (name >> 16u) & 255u, name >> 24u) / 255.0;
}`;

/** Lines with round ends, and points, which are lines without a length: two triangles each, facing the camera. */
export const lineVertex = HEAD + `
uniform mat4 modelViewMatrix, projectionMatrix;
uniform sampler2D ends;  // two of four numbers: one end and the kind, the other end and a scalar
uniform vec2 size;       // of the picture, in pixels
uniform float widths[6], pixelRatio;
out vec2 at;
flat out float reach, radius, scalar;
flat out int kind;
${FETCH}
void main() {
  uint line = uint(gl_VertexID) / 6u, corner = uint(gl_VertexID) % 6u;
  vec4 first = texelFetch(ends, place(2u * line), 0), second = texelFetch(ends, place(2u * line + 1u), 0);
  kind = int(first.w);
  scalar = second.w;
  vec4 a = modelViewMatrix * vec4(first.xyz, 1.0), b = modelViewMatrix * vec4(second.xyz, 1.0);
  bool perspective = projectionMatrix[2][3] == -1.0;
  float nearest = -1e-3;  // in front of the camera
  if (perspective) {
    if (a.z > nearest && b.z > nearest) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    if (a.z > nearest) a = mix(b, a, (nearest - b.z) / (a.z - b.z));
    if (b.z > nearest) b = mix(a, b, (nearest - a.z) / (b.z - a.z));
  }
  // A little nearer than they are, so that they lie on the faces that they border.
  if (perspective) { a.xyz *= 0.998; b.xyz *= 0.998; }
  vec4 p = projectionMatrix * a, q = projectionMatrix * b;
  vec2 from = p.xy / p.w * size * 0.5, to = q.xy / q.w * size * 0.5;
  float span = length(to - from);
  vec2 along = span > 1e-4 ? (to - from) / span : vec2(1.0, 0.0), across = vec2(-along.y, along.x);
  radius = widths[kind] * pixelRatio;
  reach = span > 1e-4 ? span : 0.0;
  float margin = radius + 1.0;
  bool end = corner == 1u || corner == 2u || corner == 4u, up = corner == 2u || corner == 4u || corner == 5u;
  vec4 here = end ? q : p;
  at = vec2(end ? reach + margin : -margin, up ? margin : -margin);
  vec2 pixel = from + along * at.x + across * at.y;
  gl_Position = vec4(pixel / (size * 0.5) * here.w, here.z - (perspective ? 0.0 : 1e-3) * here.w, here.w);
}`;

export const lineFragment = HEAD + `
uniform vec4 paints[6];
uniform sampler2D colors;
uniform bool colored;
in vec2 at;
flat in float reach, radius, scalar;
flat in int kind;
layout(location = 0) out vec4 color;
void main() {
  float distance = length(vec2(at.x - clamp(at.x, 0.0, reach), at.y));
  float covered = 1.0 - smoothstep(radius - 0.6, radius + 0.6, distance);
  vec4 paint = paints[kind];
  if (kind == 4 && colored && scalar >= 0.0) paint.rgb = texture(colors, vec2(clamp(scalar, 0.0, 1.0), 0.5)).rgb;
  if (covered * paint.a < 0.02) discard;
  color = vec4(paint.rgb, paint.a * covered);
}`;
