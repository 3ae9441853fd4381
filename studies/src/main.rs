//! Program that prints the tables and figures of motile's documents.
//!
//! `cargo run --release -p studies -- NAME` runs one of them; `--help` lists the names, `NAME --help` its flags.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod animations;
mod book;
mod exchange;
mod gel;
mod hard_cases;
mod instructions;
mod many;
mod nucleus;
mod pages;
mod passage;
mod pictures;
mod shared_benchmark;
mod site;
mod steady_states;
mod sums;
mod suspensions;
mod tables;
mod threads;
mod time_steps;
mod track;
mod tubes;
mod validation;
mod warnings;
mod work_precision;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Runs a study: what prints a table or a figure of motile's documents.
#[derive(Debug, Parser)]
#[command(name = "studies", disable_help_subcommand = true)]
struct Flags {
    #[command(subcommand)]
    study: Study,
}

#[derive(Debug, Subcommand)]
#[command(rename_all = "snake_case")]
enum Study {
    Validation(validation::Flags),
    WorkPrecision(work_precision::Flags),
    SteadyStates(steady_states::Flags),
    Figure(book::FigureFlags),
    Figures(book::FiguresFlags),
    HardCases(hard_cases::Flags),
    TimeSteps(time_steps::Flags),
    Threads(threads::Flags),
    Tubes(tubes::Flags),
    Gel(gel::Flags),
    Warnings(warnings::Flags),
    Instructions(instructions::Flags),
    Many(many::Flags),
    Sums(sums::Flags),
    Suspensions(suspensions::Flags),
    Nucleus(nucleus::Flags),
    Exchange(exchange::Flags),
    /// Lists the tables that are older than the last change of what they measure
    Stale,
    Pages(pages::PagesFlags),
    Site(site::Flags),
    Pictures(pictures::Flags),
    Animations(animations::Flags),
    SharedBenchmark(shared_benchmark::Flags),
}

fn main() -> ExitCode {
    motile_cli::command_line::run(|flags: &Flags| match &flags.study {
        Study::Validation(flags) => validation::run(flags),
        Study::WorkPrecision(flags) => work_precision::run(flags),
        Study::SteadyStates(flags) => steady_states::run(flags),
        Study::Figure(flags) => book::figure(flags),
        Study::Figures(flags) => book::figures(flags),
        Study::HardCases(flags) => hard_cases::run(flags),
        Study::TimeSteps(flags) => time_steps::run(flags),
        Study::Threads(flags) => threads::run(flags),
        Study::Tubes(flags) => tubes::run(flags),
        Study::Gel(flags) => gel::run(flags),
        Study::Warnings(flags) => warnings::run(flags),
        Study::Instructions(flags) => instructions::run(flags),
        Study::Many(flags) => many::run(flags),
        Study::Sums(flags) => sums::run(flags),
        Study::Suspensions(flags) => suspensions::run(flags),
        Study::Nucleus(flags) => nucleus::run(flags),
        Study::Exchange(flags) => exchange::run(flags),
        Study::Stale => tables::stale(),
        Study::Pages(flags) => pages::pages(flags),
        Study::Site(flags) => site::run(flags),
        Study::Pictures(flags) => pictures::run(flags),
        Study::Animations(flags) => animations::run(flags),
        Study::SharedBenchmark(flags) => shared_benchmark::run(flags),
    })
}
