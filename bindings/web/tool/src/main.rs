//! Makes the page's JavaScript module from the compiled crate: `tool WASM FOLDER web|nodejs`.

mod order;

use std::{fs, path::Path};

use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, folder, target] = arguments.as_slice() else { return Err("usage: WASM FOLDER web|nodejs".into()) };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(input).out_name("motile").typescript(false).remove_name_section(true);
    bindgen.remove_producers_section(true).omit_default_module_path(false);
    match target.as_str() {
        "web" => bindgen.web(true)?,
        "nodejs" => bindgen.nodejs(true)?,
        other => return Err(format!("there is no target {other}: give web or nodejs").into()),
    };
    bindgen.generate(folder)?;
    let module = Path::new(folder).join("motile_bg.wasm");
    Ok(fs::write(&module, order::alike(&fs::read(&module)?)?)?)
}
