use super::*;

/// `.ci/run` runs it, with the program that the other tests are in: that of the studies takes minutes to build.
#[test]
#[ignore = "needs valgrind"]
fn counts_are_those_of_the_table() {
    run(&Flags { write: false }).unwrap();
}
