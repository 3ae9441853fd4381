use super::time_label;

#[test]
fn times_have_as_many_decimals_as_tell_them() {
    for (time, label) in [(0.0, "0.0"), (0.1 + 0.2, "0.3"), (0.37, "0.37"), (12.0, "12.0"), (0.947_059, "0.947")] {
        assert_eq!(time_label(time), label);
    }
}
