//! Makes the page's JavaScript module from the compiled crate: `motile-web-tool WASM FOLDER`.

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder] = arguments.as_slice() else { return Err("usage: motile-web-tool WASM FOLDER".into()) };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).out_name("motile").typescript(false).remove_name_section(true);
    bindgen.remove_producers_section(true).omit_default_module_path(false).web(true)?;
    Ok(bindgen.generate(folder)?)
}
