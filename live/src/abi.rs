//! Three functions for a page that has nothing but WebAssembly: memory for a question, the
//! question, and the memory back.

#![allow(unsafe_code)]

/// So many bytes for a question.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    Box::into_raw(vec![0u8; length].into_boxed_slice()).cast()
}

/// Answers the question in this room, which it takes back. The answer begins with its length in
/// four bytes, the lowest first; it is given back by [`back`].
///
/// # Safety
/// The room must be one that [`room`] has given for so many bytes, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ask(question: *mut u8, length: usize) -> *mut u8 {
    // SAFETY: the room was made by `room` for this length.
    let question = unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(question, length)) };
    let answer = super::answer(&String::from_utf8_lossy(&question));
    let length = u32::try_from(answer.len()).expect("less than 4 GB").to_le_bytes();
    Box::into_raw([&length, answer.as_bytes()].concat().into_boxed_slice()).cast()
}

/// Takes an answer of this length back, its first four bytes not counted.
///
/// # Safety
/// It must be one that [`ask`] has given, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn back(answer: *mut u8, length: usize) {
    // SAFETY: `ask` made it for this length and four bytes.
    drop(unsafe { Box::from_raw(std::ptr::slice_from_raw_parts_mut(answer, length + 4)) });
}
