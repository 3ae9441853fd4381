use super::*;

#[test]
fn causes_are_told_once() {
    let error = anyhow::anyhow!("no such file").context("at time 3: no such file").context("reading");
    assert_eq!(explained(&error), "reading: at time 3: no such file");
}
