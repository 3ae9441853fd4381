//! Copy of a module that notes which of its functions are called.

use std::convert::Infallible;

use wasm_encoder::reencode::{self, Reencode};
use wasm_encoder::{CodeSection, Instruction, MemArg, MemoryType, Module};
use wasmparser::{FunctionBody, Parser};

/// Bytes of a page of memory.
const PAGE: u64 = 65_536;

/// A module that sets a byte of its memory, from a place on, for each function that is called.
pub(crate) struct Covered {
    pub module: Vec<u8>,
    /// First of these bytes: those of its functions follow, imported ones left out.
    pub place: u64,
    pub functions: usize,
}

impl Covered {
    /// Copy of a module, with a page of memory more.
    ///
    /// # Errors
    /// Bytes that are no module; more functions than a page has bytes.
    pub(crate) fn of(bytes: &[u8]) -> Result<Self, Box<dyn std::error::Error>> {
        let mut covered = Self { module: Vec::new(), place: 0, functions: 0 };
        let mut module = Module::new();
        covered.parse_core_module(&mut module, Parser::new(0), bytes)?;
        covered.module = module.finish();
        if covered.functions as u64 > PAGE {
            return Err(format!("the module has {} functions, more than {PAGE}", covered.functions).into());
        }
        Ok(covered)
    }
}

impl Reencode for Covered {
    type Error = Infallible;

    fn memory_type(&mut self, memory: wasmparser::MemoryType) -> Result<MemoryType, reencode::Error> {
        self.place = memory.initial * PAGE;
        Ok(MemoryType { minimum: memory.initial + 1, ..memory.into() })
    }

    fn parse_function_body(&mut self, code: &mut CodeSection, body: FunctionBody<'_>) -> Result<(), reencode::Error> {
        let mut function = self.new_function_with_parsed_locals(&body)?;
        let offset = self.place + self.functions as u64;
        self.functions += 1;
        function.instruction(&Instruction::I32Const(0)).instruction(&Instruction::I32Const(1));
        function.instruction(&Instruction::I32Store8(MemArg { offset, align: 0, memory_index: 0 }));
        let mut instructions = body.get_operators_reader()?;
        while !instructions.eof() {
            function.instruction(&self.parse_instruction(&mut instructions)?);
        }
        code.function(&function);
        Ok(())
    }
}
