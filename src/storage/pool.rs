//! The chapter's matrix manager: returned buffers are reused.
//!
//! A step needs the same few buffers as the step before, slightly shorter or longer as contacts
//! come and go. The pool returns the smallest one that is long enough and, if there is none,
//! allocates one with spare capacity, up to the next power of two. Only a step that is larger than
//! all before therefore allocates memory. Storage formats do the same internally: see
//! [`Storage::reset`](super::Storage::reset).

/// A pool of unused buffers of T.
///
/// ```
/// use lcplab::storage::Pool;
///
/// let mut pool = Pool::default();
/// for contacts in [60, 48, 64, 57] {
///     let buffer: Vec<f64> = pool.take(contacts);
///     assert_eq!(buffer, vec![0.0; contacts]);
///     pool.give(buffer);
/// }
/// assert_eq!((pool.allocations(), pool.takes()), (1, 4)); // 64 places served all
/// ```
#[derive(Debug, Clone, Default)]
pub struct Pool<T> {
    free: Vec<Vec<T>>,
    takes: usize,
    allocations: usize,
}

impl<T: Copy + Default> Pool<T> {
    /// A buffer of `len` default values (zeros).
    pub fn take(&mut self, len: usize) -> Vec<T> {
        let mut buffer = self.with_room(len);
        buffer.resize(len, T::default());
        buffer
    }

    /// An empty buffer with capacity for `len` values.
    pub fn with_room(&mut self, len: usize) -> Vec<T> {
        self.takes += 1;
        let fits = self.free.iter().enumerate().filter(|(_, buffer)| buffer.capacity() >= len);
        let smallest = fits.min_by_key(|(_, buffer)| buffer.capacity()).map(|(k, _)| k);
        match smallest {
            Some(k) => {
                let mut buffer = self.free.swap_remove(k);
                buffer.clear();
                buffer
            }
            None => {
                self.allocations += 1;
                Vec::with_capacity(len.next_power_of_two())
            }
        }
    }

    /// Records that a buffer in use grew, from one capacity to another.
    pub(super) fn count_growth(&mut self, before: usize, after: usize) {
        self.allocations += usize::from(after > before);
    }

    /// Returns a buffer to the pool.
    pub fn give(&mut self, buffer: Vec<T>) {
        self.free.push(buffer);
    }

    /// The number of buffer requests.
    pub fn takes(&self) -> usize {
        self.takes
    }

    /// The number of allocations.
    pub fn allocations(&self) -> usize {
        self.allocations
    }

    /// The memory of the unused buffers (bytes).
    pub fn bytes(&self) -> usize {
        self.free.iter().map(|buffer| buffer.capacity() * size_of::<T>()).sum()
    }
}
