use super::*;

#[test]
fn parts_decide_in_the_order_of_what_is_worse() {
    use Stability::{Stable, Undecided, Unstable};
    assert_eq!(Stability::of_parts([]), Stable);
    assert_eq!(Stability::of_parts([Stable, Undecided, Stable]), Undecided);
    assert_eq!(Stability::of_parts([Undecided, Unstable, Stable]), Unstable);
    assert_eq!(Stability::of_rate(f64::NAN, 0.1).decided(), None);
    assert_eq!([Stability::of_rate(0.2, 0.1), Stability::of_rate(0.1, 0.1)], [Unstable, Undecided]);
}
