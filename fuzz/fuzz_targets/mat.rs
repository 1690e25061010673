#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lcplab_fuzz::read("mat", bytes));
