#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| motile_fuzz::scene_file(bytes));
