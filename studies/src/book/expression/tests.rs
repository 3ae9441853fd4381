use super::{Definitions, Expression, Row};

fn definitions() -> Definitions {
    let pairs = [("sum", "inside + outside"), ("half", "sum / 2"), ("round", "around"), ("around", "round")];
    pairs.map(|(name, text)| (name.to_owned(), text.to_owned())).into()
}

#[test]
fn expressions_have_their_values() {
    let row: Row = [("inside", 3.0), ("outside", 1.0), ("x", -2.0)].map(|(name, v)| (name.to_owned(), v)).into();
    for (text, expected) in [
        ("1 + 2 * 3 ^ 2", 19.0),
        ("-x ^ 2", -4.0),
        ("2 - 3 - 4", -5.0),
        ("abs(x) * half", 4.0),
        ("x < 0 & inside == 3 | 0", 1.0),
        ("1.5e-1 * sum", 0.6),
        ("inside >= 4", 0.0),
        ("exp(ln(2)) / sqrt(4)", 1.0),
    ] {
        let found = Expression::parse(text, &definitions()).expect(text).value(&row);
        assert!((found - expected).abs() < 1e-12, "{text} = {found}, expected {expected}");
    }
    let unknown = Expression::parse("half + other", &definitions()).expect("an expression");
    assert_eq!(unknown.names(), ["inside", "outside", "other"]);
    assert!(unknown.value(&row).is_nan());
}

#[test]
fn what_is_no_expression_is_told() {
    for (text, told) in [
        ("1 +", "is missing before ''"),
        ("(1 + 2", "')' is missing"),
        ("1 2", "'2' is left over"),
        ("sinus(x)", "no function sinus"),
        ("round", "go in a circle"),
        ("1e", "'1e'"),
    ] {
        let error = format!("{:#}", Expression::parse(text, &definitions()).expect_err(text));
        assert!(error.contains(told), "{text}: {error}");
    }
}
