// A scene in the part of the address after #, which is never sent to a server: deflated, as base64url.

async function through(bytes, stream) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** Part of an address for the text of a scene. */
export async function packed(text) {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return "s=" + btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

async function unfolded(packed) {
  const binary = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
  return new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
}

/**
 * Text of the scene in a part of an address; null where there is none. Whatever follows the scene in a message that
 * quotes the link, such as a full stop or a bracket, is left out: the letters of a link have none of these. A link that
 * is cut short is an error.
 */
export async function unpacked(hash) {
  const found = /^#?s(?:=|%3[dD])([\w-]*)/.exec(hash);
  if (!found) return null;
  let packed = found[1];
  for (;;) {
    try {
      return await unfolded(packed);
    } catch (error) {
      // Underscores and hyphens are letters of a link, but also marks about one.
      if (!/[-_]$/.test(packed)) throw error;
      packed = packed.slice(0, -1);
    }
  }
}
