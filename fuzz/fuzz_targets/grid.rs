#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| lcplab_fuzz::read_grid(text));
