//! Three functions for a page that uses WebAssembly without bindings: allocate memory for a
//! question, answer it, and free the answer.

#![allow(unsafe_code)]

/// Allocates this number of bytes for a question.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    Box::into_raw(vec![0u8; length].into_boxed_slice()).cast()
}

/// Answers the question in this memory, which it frees. The answer begins with its length in four
/// bytes, the lowest first; [`back`] frees it.
///
/// # Safety
/// The memory must come from [`room`] for this number of bytes, and must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ask(question: *mut u8, length: usize) -> *mut u8 {
    // SAFETY: the room was made by `room` for this length.
    let question = unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(question, length)) };
    let answer = super::answer(&String::from_utf8_lossy(&question));
    let length = u32::try_from(answer.len()).expect("less than 4 GB").to_le_bytes();
    Box::into_raw([&length, answer.as_bytes()].concat().into_boxed_slice()).cast()
}

/// Frees an answer of this length, not counting its first four bytes.
///
/// # Safety
/// The answer must come from [`ask`], and must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn back(answer: *mut u8, length: usize) {
    // SAFETY: `ask` made it for this length and four bytes.
    drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(answer, length + 4)) });
}
