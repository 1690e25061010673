#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = lcplab_fuzz::simulator(bytes); // too few bytes are no problem
});
