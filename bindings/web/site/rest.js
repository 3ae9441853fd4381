// The rest of the module, which the first scenes do not call: it is loaded where something of it is called, at once.

/** Makes the rest for what the first part exports. */
export function load(first) {
  const request = new XMLHttpRequest();
  request.open("GET", new URL("motile_rest.wasm", import.meta.url), false);
  // Bytes as letters: outside of workers nothing else comes at once.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  request.send();
  if (request.status !== 200) throw new Error(`the rest of the page is missing (${request.status}): load it again`);
  const bytes = Uint8Array.from(request.responseText, (letter) => letter.charCodeAt(0) & 255);
  new WebAssembly.Instance(new WebAssembly.Module(bytes), { first });
}
