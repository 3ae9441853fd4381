//! Program that prints the tables and figures of motile's documents.
//!
//! `cargo run --release -p studies -- NAME` runs one of them; `--help` lists the names, `NAME --help` its flags.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod animations;
mod birth_death;
mod book;
mod exchange;
mod gel;
mod instructions;
mod many;
mod nucleus;
mod pages;
mod pictures;
mod questions;
mod scene_keys;
mod shared_benchmark;
mod site;
mod space_droplets;
mod steady_states;
mod sums;
mod suspensions;
mod tables;
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
    TimeSteps(time_steps::Flags),
    Tubes(tubes::Flags),
    /// Compares closed forms of birth-death and branching processes with simulations
    BirthDeath(tables::Keep),
    /// Lets passive droplets swim by a gel alone
    Gel(tables::Keep),
    /// Compares warnings of runs with their errors
    Warnings(tables::Keep),
    Instructions(instructions::Flags),
    /// Measures the cost of the methods over the number of droplets
    Many(tables::Keep),
    /// Measures the cost of boundary integrals over many nodes
    Sums(tables::Keep),
    Suspensions(suspensions::Flags),
    Nucleus(nucleus::Flags),
    Questions(questions::Flags),
    SpaceDroplets(space_droplets::Flags),
    /// Lets droplets exchange their particles with the inside
    Exchange(tables::Keep),
    Witnesses(tables::WitnessFlags),
    All(tables::AllFlags),
    Pages(pages::PagesFlags),
    Site(site::Flags),
    Pictures(pictures::Flags),
    Animations(animations::Flags),
    SharedBenchmark(shared_benchmark::Flags),
}

fn main() -> ExitCode {
    motile_cli::command_line::run(run)
}

fn run(flags: &Flags) -> anyhow::Result<()> {
    match &flags.study {
        Study::Validation(flags) => validation::run(flags),
        Study::WorkPrecision(flags) => work_precision::run(flags),
        Study::SteadyStates(flags) => steady_states::run(flags),
        Study::Figure(flags) => book::figure(flags),
        Study::Figures(flags) => book::figures(flags),
        Study::TimeSteps(flags) => time_steps::run(flags),
        Study::Tubes(flags) => tubes::run(flags),
        Study::BirthDeath(keep) => birth_death::run(*keep),
        Study::Gel(keep) => gel::run(*keep),
        Study::Warnings(keep) => warnings::run(*keep),
        Study::Instructions(flags) => instructions::run(flags),
        Study::Many(keep) => many::run(*keep),
        Study::Sums(keep) => sums::run(*keep),
        Study::Suspensions(flags) => suspensions::run(flags),
        Study::Nucleus(flags) => nucleus::run(flags),
        Study::Questions(flags) => questions::run(flags),
        Study::SpaceDroplets(flags) => space_droplets::run(flags),
        Study::Exchange(keep) => exchange::run(*keep),
        Study::Witnesses(flags) => tables::witnesses(flags),
        Study::All(flags) => tables::all(flags),
        Study::Pages(flags) => pages::pages(flags),
        Study::Site(flags) => site::run(flags),
        Study::Pictures(flags) => pictures::run(flags),
        Study::Animations(flags) => animations::run(flags),
        Study::SharedBenchmark(flags) => shared_benchmark::run(flags),
    }
}
