//! Makes the page's JavaScript module from the compiled crate: `tool WASM FOLDER REHEARSAL`.
//!
//! The module comes in two parts: `motile_bg.wasm` has what the script of the rehearsal calls, in node, and calls
//! what else there is in `motile_rest.wasm`, which `rest.js` loads then.

mod cover;
mod order;
mod parts;

use std::{error::Error, fs, path::Path, process::Command};

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder, rehearsal] = arguments.as_slice() else { return Err("usage: WASM FOLDER REHEARSAL".into()) };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).out_name("motile").typescript(false).remove_name_section(true);
    bindgen.remove_producers_section(true).omit_default_module_path(false).web(true)?;
    bindgen.generate(folder)?;

    let path = |name: &str| Path::new(folder).join(name);
    let (module, script) = (path("motile_bg.wasm"), path("motile.js"));
    let whole = fs::read(&module)?;
    let covered = cover::Covered::of(&whole)?;
    fs::write(&module, &covered.module)?;
    let node = Command::new("node").arg(rehearsal).arg(&script).arg(covered.place.to_string()).output();
    let node = node.map_err(|error| format!("node, which rehearses what visitors do first: {error}"))?;
    if !node.status.success() {
        return Err(format!("the rehearsal failed:\n{}", String::from_utf8_lossy(&node.stderr)).into());
    }
    let called: Vec<bool> = node.stdout.iter().map(|&byte| byte == b'1').take(covered.functions).collect();
    let parts = parts::Parts::of(&whole, &called)?;
    fs::write(&module, &parts.first)?;
    fs::write(path("motile_rest.wasm"), &parts.rest)?;

    // What the first part imports of `rest.js` is handed over where the script hands over the other imports.
    let text = fs::read_to_string(&script)?;
    let imports = "\"./motile_bg.js\": import0,";
    if text.matches(imports).count() != 1 {
        return Err(format!("the script has no single place where it says {imports}").into());
    }
    let more = format!("{imports}\n        \"./rest.js\": {{ load: () => load(wasm) }},");
    Ok(fs::write(&script, format!("import {{ load }} from \"./rest.js\";\n{}", text.replace(imports, &more)))?)
}
