#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = lcplab_fuzz::diagnose(bytes); // too few bytes are no problem
});
