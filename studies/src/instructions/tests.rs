use super::*;

/// `.ci/run` runs it, because the program of the tests is built already. `UPDATE=1` renews the table.
#[test]
#[ignore = "needs valgrind"]
fn counts_are_those_of_the_table() {
    run(&Flags { write: env::var_os("UPDATE").is_some() }).unwrap();
}
