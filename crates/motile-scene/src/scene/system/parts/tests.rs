use std::sync::Mutex;

use motile_base::Vec2;

use super::*;
use crate::MarkerBody;

/// With many entries the bodies are divided among threads: each has its own range of a list, one after the other.
#[test]
fn each_body_has_its_range_and_its_values() {
    let counts = [7, 3000, 1, 4000, 0, 2500, 12];
    let body = |count: &usize| -> Box<dyn Body> {
        Box::new(MarkerBody::new(count.to_string(), vec![Vec2::ZERO; *count], |_, _| {}))
    };
    let mut bodies: Vec<Box<dyn Body>> = counts.iter().map(body).collect();
    for entries in [10, 100_000] {
        let mut values = vec![0_usize; counts.iter().sum()];
        let seen = Mutex::new(Vec::new());
        let failed = Parts::of(&mut bodies, entries, &mut values).each(&markers, &|index, body, range, part| {
            assert_eq!(body.name(), counts[index].to_string());
            part.iter_mut().zip(range.clone()).for_each(|(value, entry)| *value = 10 * entry + index);
            seen.lock().unwrap().push((index, range.start, range.end, part.len()));
            Ok(())
        });
        assert!(failed.is_none());
        let mut seen = seen.into_inner().unwrap();
        seen.sort_unstable();
        let mut start = 0;
        for (index, count) in counts.into_iter().enumerate() {
            assert_eq!(seen[index], (index, start, start + count, count), "{entries}");
            assert!(values[start..][..count].iter().enumerate().all(|(k, value)| *value == 10 * (start + k) + index));
            start += count;
        }
    }
}
