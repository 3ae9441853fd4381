use super::encode;

#[test]
fn the_examples_of_rfc_4648() {
    let cases =
        [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
    for (plain, coded) in cases {
        assert_eq!(encode(plain.as_bytes()), coded);
    }
}
