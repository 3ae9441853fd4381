//! Fuzzing without libFuzzer and with a stable compiler: random changes of valid inputs.
//!
//! `cargo run --release --bin motile-fuzz -- TARGET SECONDS` in this directory, TARGET being checkpoint, gmsh, scene or
//! flags; with `corpus` in place of the seconds it writes the valid inputs to `corpus/TARGET/` for `cargo fuzz`. Tells
//! how many inputs it has tried; a panic ends it, and the input is then in `crash-TARGET`.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// A generator of numbers that are the same every time (xorshift64*).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % bound.max(1)
    }
}

/// Numbers that are apt to go wrong, as text.
const WORDS: [&str; 14] = [
    "0",
    "-1",
    "1e308",
    "-1e-320",
    "nan",
    "inf",
    "18446744073709551616",
    "99999999999",
    "0.0000001",
    "$",
    " ",
    "\n",
    "--",
    "-0",
];

fn mutate(input: &mut Vec<u8>, other: &[u8], numbers: &mut Numbers) {
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(input.len() + 1).min(input.len());
        match numbers.below(7) {
            0 if at < input.len() => input[at] ^= 1 << numbers.below(8),
            1 if at < input.len() => input[at] = numbers.below(256) as u8,
            2 => {
                let end = (at + numbers.below(16)).min(input.len());
                input.drain(at..end);
            }
            3 => {
                let word = WORDS[numbers.below(WORDS.len())];
                input.splice(at..at, word.bytes());
            }
            4 => {
                let from = numbers.below(other.len() + 1).min(other.len());
                let to = (from + numbers.below(64)).min(other.len());
                input.splice(at..at, other[from..to].iter().copied());
            }
            5 if at + 8 <= input.len() => {
                let special = [f64::NAN, f64::INFINITY, -0.0, 1e300, f64::MIN_POSITIVE, -1.0];
                input[at..at + 8].copy_from_slice(&special[numbers.below(special.len())].to_le_bytes());
            }
            _ => {
                let words: Vec<usize> = (0..input.len()).filter(|&k| input[k] == b' ' || input[k] == b'\n').collect();
                if words.len() > 1 {
                    let k = numbers.below(words.len() - 1);
                    let word = WORDS[numbers.below(WORDS.len())];
                    input.splice(words[k] + 1..words[k + 1], word.bytes());
                }
            }
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [target, amount] = arguments.as_slice() else {
        eprintln!("give a target (checkpoint, gmsh, scene or flags) and a number of seconds or 'corpus'");
        std::process::exit(2);
    };
    let run: fn(&[u8]) = match target.as_str() {
        "checkpoint" => motile_fuzz::checkpoint,
        "scene" => motile_fuzz::scene_file,
        "gmsh" => motile_fuzz::gmsh,
        "flags" => motile_fuzz::flags,
        _ => {
            eprintln!("there is no target {target}: give checkpoint, gmsh, scene or flags");
            std::process::exit(2);
        }
    };
    let mut corpus = motile_fuzz::corpus(target);
    if amount == "corpus" {
        let directory = std::path::Path::new("corpus").join(target);
        std::fs::create_dir_all(&directory).expect("a directory");
        for (index, input) in corpus.iter().enumerate() {
            std::fs::write(directory.join(index.to_string()), input).expect("a file");
        }
        return;
    }
    let seconds = amount.parse().expect("a number of seconds");
    let start = Instant::now();
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut executions = 0_u64;
    let mut slowest = Duration::ZERO;
    while start.elapsed() < Duration::from_secs(seconds) {
        let mut input = corpus[numbers.below(corpus.len())].clone();
        let other = corpus[numbers.below(corpus.len())].clone();
        mutate(&mut input, &other, &mut numbers);
        let before = Instant::now();
        if catch_unwind(AssertUnwindSafe(|| run(&input))).is_err() {
            let path = format!("crash-{target}");
            std::fs::write(&path, &input).expect("a file");
            eprintln!("a panic after {executions} executions, the input is in {path}");
            std::process::exit(1);
        }
        slowest = slowest.max(before.elapsed());
        executions += 1;
        // Some of what was tried is changed further.
        if numbers.below(200) == 0 && corpus.len() < 500 && input.len() < 20_000 {
            corpus.push(input);
        }
    }
    println!(
        "{target}: {executions} executions in {seconds} s, no panic, the slowest took {:.3} s",
        slowest.as_secs_f64()
    );
}
