//! A module in two parts, the second of which is loaded when one of its functions is called.

use std::collections::{BTreeMap, BTreeSet};
use std::convert::Infallible;

use wasm_encoder::reencode::{self, Reencode, utils};
use wasm_encoder::{
    CodeSection, ConstExpr, ElementSection, Elements, EntityType, ExportKind, ExportSection, Function, FunctionSection,
    ImportSection, Instruction, Module, RawSection, TableSection,
};
use wasmparser::{ElementItems, FunctionBody, Operator, Parser, Payload, TypeRef};

use crate::order;

/// Length of functions that are in the first part wherever that calls them: they weigh little more than what would
/// stand for them, and ways that are not rehearsed lead through them (bytes).
const SMALL: usize = 128;

type Error = Box<dyn std::error::Error>;

/// Two modules in place of one. Before the first calls anything of the rest it calls `load`, which it imports of
/// `./rest.js`, and which has to make an instance of the rest with the exports of the first as `first`.
pub(crate) struct Parts {
    pub first: Vec<u8>,
    pub rest: Vec<u8>,
}

impl Parts {
    /// Parts of a module: the first has the functions that are called, of those that are not imported.
    ///
    /// # Errors
    /// Bytes that are no module, or one of a kind that `wasm-bindgen` does not make.
    pub(crate) fn of(bytes: &[u8], called: &[bool]) -> Result<Self, Error> {
        let whole = Whole::of(bytes)?;
        let cut = Cut::of(&whole, called)?;
        Ok(Self { first: cut.first(&whole)?, rest: cut.rest(&whole)? })
    }
}

/// What a module has.
#[derive(Default)]
struct Whole<'b> {
    bytes: &'b [u8],
    sections: Vec<Payload<'b>>,
    /// Number of parameters of each type.
    parameters: Vec<u32>,
    /// Type of functions without parameters and results.
    plain: Option<u32>,
    /// Type of each function, imported ones first.
    types: Vec<u32>,
    imported: u32,
    bodies: Vec<FunctionBody<'b>>,
    /// Slots of the table, from one on, with their functions.
    table: (u32, Vec<u32>),
    exported: Vec<u32>,
    /// Tables, memories and globals.
    things: Vec<(EntityType, ExportKind, u32)>,
    /// Number of slots of the table.
    slots: u32,
}

impl<'b> Whole<'b> {
    fn of(bytes: &'b [u8]) -> Result<Self, Error> {
        let mut whole = Self { bytes, ..Self::default() };
        let none = BTreeMap::new();
        let mut same = Renumbered(&none);
        for payload in Parser::new(0).parse_all(bytes) {
            let payload = payload?;
            match &payload {
                Payload::TypeSection(types) => {
                    for (number, kind) in (0..).zip(types.clone().into_iter_err_on_gc_types()) {
                        let kind = kind?;
                        whole.parameters.push(kind.params().len() as u32);
                        if kind.params().is_empty() && kind.results().is_empty() {
                            whole.plain = Some(number);
                        }
                    }
                }
                Payload::ImportSection(imports) => {
                    for import in imports.clone().into_imports() {
                        let TypeRef::Func(kind) = import?.ty else { return Err("only functions are imported".into()) };
                        whole.types.push(kind);
                    }
                    whole.imported = whole.types.len() as u32;
                }
                Payload::FunctionSection(functions) => {
                    for kind in functions.clone() {
                        whole.types.push(kind?);
                    }
                }
                Payload::TableSection(tables) => {
                    for (number, table) in (0..).zip(tables.clone()) {
                        let table = same.table_type(table?.ty)?;
                        whole.things.push((table.into(), ExportKind::Table, number));
                    }
                }
                Payload::MemorySection(memories) => {
                    for (number, memory) in (0..).zip(memories.clone()) {
                        whole.things.push((same.memory_type(memory?)?.into(), ExportKind::Memory, number));
                    }
                }
                Payload::GlobalSection(globals) => {
                    for (number, global) in (0..).zip(globals.clone()) {
                        whole.things.push((same.global_type(global?.ty)?.into(), ExportKind::Global, number));
                    }
                }
                Payload::ExportSection(exports) => {
                    for export in exports.clone() {
                        let export = export?;
                        if export.kind == wasmparser::ExternalKind::Func {
                            whole.exported.push(export.index);
                        }
                    }
                }
                Payload::ElementSection(elements) => {
                    let one: Vec<_> = elements.clone().into_iter().collect::<Result<_, _>>()?;
                    let [wasmparser::Element { kind, items: ElementItems::Functions(functions), .. }] = &*one else {
                        return Err("the table of functions is filled at once".into());
                    };
                    let wasmparser::ElementKind::Active { table_index: None | Some(0), offset_expr } = kind else {
                        return Err("only the first table has functions".into());
                    };
                    let Operator::I32Const { value } = offset_expr.get_operators_reader().read()? else {
                        return Err("the table of functions is filled from a constant place on".into());
                    };
                    whole.table = (value as u32, functions.clone().into_iter().collect::<Result<_, _>>()?);
                }
                Payload::CodeSectionEntry(body) => whole.bodies.push(body.clone()),
                Payload::StartSection { .. } | Payload::DataCountSection { .. } => {
                    return Err("a module that starts by itself, or loads data as it runs, is not divided".into());
                }
                _ => {}
            }
            whole.sections.push(payload);
        }
        let table = whole.things.iter().find_map(|thing| match thing {
            (EntityType::Table(table), _, 0) => Some(table.minimum as u32),
            _ => None,
        });
        whole.slots = table.ok_or("a module without a table is not divided")?;
        Ok(whole)
    }

    /// Type of functions without parameters and results.
    fn plain(&self) -> Result<u32, Error> {
        Ok(self.plain.ok_or("there is no function without parameters")?)
    }

    /// Functions that a function calls.
    fn callees(&self, function: u32) -> Result<BTreeSet<u32>, Error> {
        let mut callees = BTreeSet::new();
        let mut instructions = self.body(function).get_operators_reader()?;
        while !instructions.eof() {
            match instructions.read()? {
                Operator::Call { function_index } => _ = callees.insert(function_index),
                Operator::RefFunc { .. } | Operator::ReturnCall { .. } => return Err("only calls are divided".into()),
                _ => {}
            }
        }
        Ok(callees)
    }

    fn body(&self, function: u32) -> &FunctionBody<'b> {
        &self.bodies[(function - self.imported) as usize]
    }

    /// Functions in an order in which they compress well.
    fn ordered(&self, functions: &[u32]) -> Vec<u32> {
        let bodies: Vec<&[u8]> = functions.iter().map(|&f| self.body(f).as_bytes()).collect();
        order::alike(&bodies).into_iter().map(|place| functions[place]).collect()
    }

    /// Adds the bodies of functions, with new numbers of those that they call.
    fn write(&self, functions: &[u32], numbers: &BTreeMap<u32, u32>, code: &mut CodeSection) -> Result<(), Error> {
        for &function in functions {
            utils::parse_function_body(&mut Renumbered(numbers), code, self.body(function).clone())?;
        }
        Ok(())
    }
}

/// New numbers of functions; others keep theirs.
struct Renumbered<'n>(&'n BTreeMap<u32, u32>);

impl Reencode for Renumbered<'_> {
    type Error = Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, reencode::Error> {
        Ok(*self.0.get(&function).unwrap_or(&function))
    }
}

/// Which function goes where.
struct Cut {
    /// Functions of the first part, and of the rest.
    first: Vec<u32>,
    rest: Vec<u32>,
    /// Functions of the rest that the first part mentions, with their slots of the table.
    slots: BTreeMap<u32, u32>,
    /// Functions of the first part, and imported ones, that the rest calls.
    lent: BTreeSet<u32>,
    /// Slot of the function that loads the rest, the last one.
    load: u32,
}

impl Cut {
    fn of(whole: &Whole<'_>, called: &[bool]) -> Result<Self, Error> {
        let own = whole.imported..whole.types.len() as u32;
        let (mut first, rest): (Vec<u32>, Vec<u32>) =
            own.partition(|&function| called.get((function - whole.imported) as usize) == Some(&true));
        let mut is_rest: BTreeSet<u32> = rest.into_iter().collect();
        let mut mentioned: BTreeSet<u32> = whole.exported.iter().copied().collect();
        let mut looked_at = 0;
        while let Some(&function) = first.get(looked_at) {
            looked_at += 1;
            for callee in whole.callees(function)? {
                if is_rest.contains(&callee) && whole.body(callee).as_bytes().len() <= SMALL {
                    is_rest.remove(&callee);
                    first.push(callee);
                }
                mentioned.insert(callee);
            }
        }
        let rest: Vec<u32> = is_rest.iter().copied().collect();
        let (from, functions) = &whole.table;
        let mut slots: BTreeMap<u32, u32> = functions.iter().copied().zip(*from..).collect();
        slots.retain(|function, _| is_rest.contains(function));
        let mut load = whole.slots;
        for function in mentioned.into_iter().filter(|function| is_rest.contains(function)) {
            slots.entry(function).or_insert_with(|| {
                load += 1;
                load - 1
            });
        }
        let mut lent = BTreeSet::new();
        for &function in &rest {
            lent.extend(whole.callees(function)?.into_iter().filter(|callee| !is_rest.contains(callee)));
        }
        Ok(Self { first: whole.ordered(&first), rest: whole.ordered(&rest), slots, lent, load })
    }

    fn first(&self, whole: &Whole<'_>) -> Result<Vec<u8>, Error> {
        let plain = whole.plain()?;
        let loader = whole.imported;
        let numbers = self.first.iter().chain(self.slots.keys()).copied().zip(loader + 1..).collect();
        let mut module = Module::new();
        for payload in &whole.sections {
            match payload {
                Payload::ImportSection(section) => {
                    let mut imports = ImportSection::new();
                    utils::parse_import_section(&mut Renumbered(&numbers), &mut imports, section.clone())?;
                    imports.import("./rest.js", "load", EntityType::Function(plain));
                    module.section(&imports);
                }
                Payload::FunctionSection(_) => {
                    let mut functions = FunctionSection::new();
                    for &function in self.first.iter().chain(self.slots.keys()) {
                        functions.function(whole.types[function as usize]);
                    }
                    module.section(&functions);
                }
                Payload::TableSection(_) => {
                    let mut tables = TableSection::new();
                    for (thing, _, number) in &whole.things {
                        if let EntityType::Table(table) = thing {
                            let mut table = *table;
                            if *number == 0 {
                                (table.minimum, table.maximum) = (u64::from(self.load) + 1, None);
                            }
                            tables.table(table);
                        }
                    }
                    module.section(&tables);
                }
                Payload::ExportSection(section) => {
                    let mut exports = ExportSection::new();
                    utils::parse_export_section(&mut Renumbered(&numbers), &mut exports, section.clone())?;
                    for (place, (_, kind, number)) in whole.things.iter().enumerate() {
                        exports.export(&format!("t{place}"), *kind, *number);
                    }
                    for function in &self.lent {
                        exports.export(&name(*function), ExportKind::Func, *numbers.get(function).unwrap_or(function));
                    }
                    module.section(&exports);
                }
                Payload::ElementSection(section) => {
                    let mut elements = ElementSection::new();
                    utils::parse_element_section(&mut Renumbered(&numbers), &mut elements, section.clone())?;
                    fill(&mut elements, self.load, &[loader]);
                    module.section(&elements);
                }
                Payload::CodeSectionStart { .. } => {
                    let mut code = CodeSection::new();
                    whole.write(&self.first, &numbers, &mut code)?;
                    // In place of each function of the rest: load it, then call what is in its slot by now.
                    for (&function, &slot) in &self.slots {
                        let kind = whole.types[function as usize];
                        let mut stub = Function::new([]);
                        stub.instructions().i32_const(self.load as i32).call_indirect(0, plain);
                        for parameter in 0..whole.parameters[kind as usize] {
                            stub.instruction(&Instruction::LocalGet(parameter));
                        }
                        stub.instructions().i32_const(slot as i32).call_indirect(0, kind).end();
                        code.function(&stub);
                    }
                    module.section(&code);
                }
                Payload::CustomSection(_) => {}
                other => {
                    if let Some((id, range)) = other.as_section() {
                        module.section(&RawSection { id, data: &whole.bytes[range] });
                    }
                }
            }
        }
        Ok(module.finish())
    }

    fn rest(&self, whole: &Whole<'_>) -> Result<Vec<u8>, Error> {
        let mut module = Module::new();
        for payload in &whole.sections {
            if let Payload::TypeSection(types) = payload {
                module.section(&RawSection { id: 1, data: &whole.bytes[types.range()] });
            }
        }
        let mut imports = ImportSection::new();
        for (place, (kind, _, number)) in whole.things.iter().enumerate() {
            let mut kind = *kind;
            if let (EntityType::Table(table), 0) = (&mut kind, number) {
                (table.minimum, table.maximum) = (u64::from(self.load) + 1, None);
            }
            imports.import("first", &format!("t{place}"), kind);
        }
        for &function in &self.lent {
            imports.import("first", &name(function), EntityType::Function(whole.types[function as usize]));
        }
        let numbers: BTreeMap<u32, u32> = self.lent.iter().chain(&self.rest).copied().zip(0..).collect();
        let nothing = numbers.len() as u32;
        let mut functions = FunctionSection::new();
        for &function in &self.rest {
            functions.function(whole.types[function as usize]);
        }
        functions.function(whole.plain()?);
        let mut elements = ElementSection::new();
        let filled: BTreeMap<u32, u32> = self.slots.iter().map(|(function, &slot)| (slot, numbers[function])).collect();
        let mut run: Vec<u32> = Vec::new();
        for (&slot, &function) in &filled {
            run.push(function);
            if !filled.contains_key(&(slot + 1)) {
                fill(&mut elements, slot + 1 - run.len() as u32, &run);
                run.clear();
            }
        }
        fill(&mut elements, self.load, &[nothing]);
        let mut code = CodeSection::new();
        whole.write(&self.rest, &numbers, &mut code)?;
        let mut end = Function::new([]);
        end.instructions().end();
        code.function(&end);
        module.section(&imports).section(&functions).section(&elements).section(&code);
        Ok(module.finish())
    }
}

/// Name by which the rest imports a function.
fn name(function: u32) -> String {
    format!("f{function}")
}

/// Puts functions into slots of the table, from one on.
fn fill(elements: &mut ElementSection, slot: u32, functions: &[u32]) {
    elements.active(None, &ConstExpr::i32_const(slot as i32), Elements::Functions(functions.into()));
}
