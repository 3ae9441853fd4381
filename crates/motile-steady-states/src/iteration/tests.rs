use super::*;

/// Steps end at one, and are halved where they fail.
#[test]
fn continuation_ends_at_its_end() {
    let mut seen = Vec::new();
    let last = in_steps((0.0, 0.1), 0.4, |_, ahead| {
        seen.push(ahead);
        Ok(ahead)
    });
    assert_eq!(last.unwrap(), 1.0);
    assert!(seen.len() == 3 && seen[2] == 1.0, "{seen:?}");
    let mut tries = 0;
    let last = in_steps((0.0, 0.0), 1.0, |last, ahead| {
        tries += 1;
        if ahead - last > 0.25 { Err(SteadyError::unsupported("so long a step".to_owned(), "")) } else { Ok(ahead) }
    });
    assert!(last.unwrap() == 1.0 && tries == 2 + 4, "{tries}");
}
