//! The frame of a program: reads the command line, runs, and ends with one sentence if something is wrong.

use std::{error::Error as _, process::ExitCode};

use anyhow::Result;
use clap::{
    Parser,
    error::{ContextKind, ContextValue, ErrorKind},
};

use crate::run::explained;

/// Exit code for a command line that cannot be understood, as is usual; other failures end with 1.
const MISUSE: u8 = 2;

/// Runs a program: reads the command line into `Flags` and runs. If something is wrong, in the flags or in the run, it
/// ends with one sentence on the error output and an exit code other than zero.
///
/// ```no_run
/// /// A droplet swims.
/// #[derive(clap::Parser)]
/// struct Flags {
///     #[command(flatten)]
///     output: motile_cli::run::OutputFlags,
/// }
///
/// fn main() -> std::process::ExitCode {
///     motile_cli::command_line::run(|flags: &Flags| Ok(println!("{:?}", flags.output)))
/// }
/// ```
pub fn run<Flags: Parser>(body: impl FnOnce(&Flags) -> Result<()>) -> ExitCode {
    let flags = match Flags::try_parse() {
        Ok(flags) => flags,
        Err(error) if !error.use_stderr() => {
            // Help or version; where nobody listens there is nothing to do about it.
            let _ = error.print();
            return ExitCode::SUCCESS;
        }
        Err(error) => {
            eprintln!("error: {}", sentence(&error, &Flags::command()));
            return ExitCode::from(MISUSE);
        }
    };
    match body(&flags) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", explained(&error));
            ExitCode::FAILURE
        }
    }
}

/// Returns the fault of a command line, in one sentence.
#[must_use]
pub fn sentence(error: &clap::Error, command: &clap::Command) -> String {
    let context = |kind: ContextKind| match error.get(kind) {
        Some(ContextValue::String(text)) => text.clone(),
        Some(ContextValue::Strings(texts)) => texts.join(", "),
        _ => String::new(),
    };
    // Without the name of the value: `--box <SIDE>`.
    let flag = context(ContextKind::InvalidArg).split(' ').next().unwrap_or_default().to_string();
    let value = context(ContextKind::InvalidValue);
    let valid = context(ContextKind::ValidValue);
    let text = match error.kind() {
        ErrorKind::UnknownArgument => {
            let suggestion = context(ContextKind::SuggestedArg);
            let hint = if suggestion.is_empty() { String::new() } else { format!("did you mean {suggestion}? ") };
            format!("there is no flag {flag} ({hint}--help lists them)")
        }
        ErrorKind::InvalidValue if value.is_empty() => format!("{flag} needs a value"),
        ErrorKind::InvalidValue if !valid.is_empty() => format!("{flag} {value} is not one of {valid}"),
        ErrorKind::ValueValidation => {
            let reason = error.source().map(ToString::to_string).unwrap_or_else(|| "not valid".into());
            format!("{flag} {value}: {reason}")
        }
        ErrorKind::InvalidSubcommand | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let given = context(ContextKind::InvalidSubcommand);
            let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
            let what = if given.is_empty() {
                "the command is missing".into()
            } else {
                format!("there is no command {given:?}")
            };
            format!("{what}. Use one of {}", names.join(", "))
        }
        ErrorKind::MissingRequiredArgument => format!("{flag} is missing (--help shows what is needed)"),
        ErrorKind::ArgumentConflict => {
            let other = context(ContextKind::PriorArg).split(' ').next().unwrap_or_default().to_string();
            if other.is_empty() || other == flag {
                format!("{flag} is given more than once")
            } else {
                format!("{flag} and {other} say the same in two ways. Use only one of them")
            }
        }
        _ => {
            let whole = error.to_string();
            // The usage follows after an empty line.
            let told: Vec<&str> = whole.lines().take_while(|line| !line.trim().is_empty()).collect();
            told.join(" ").trim_start_matches("error: ").to_string()
        }
    };
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Reads a number above 0.
///
/// # Errors
/// Returns an error for the rule that the text breaks.
pub fn positive(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "must be a number above 0".to_owned())
}
