//! The chapter's matrix manager: buffers that are given back are used again.
//!
//! A step asks for the same few buffers as the step before, a little shorter or longer as contacts
//! come and go. The pool hands out the smallest one that is long enough and, where there is none,
//! makes one with room to spare, up to the next power of two. So only a step that is larger than
//! all before it asks the system for memory. Storages do the same inside: see
//! [`Storage::reset`](super::Storage::reset).

/// Buffers of T between their uses.
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
    /// A buffer of so many default values (zeros).
    pub fn take(&mut self, len: usize) -> Vec<T> {
        let mut buffer = self.with_room(len);
        buffer.resize(len, T::default());
        buffer
    }

    /// An empty buffer with room for so many values.
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

    /// Notes that a buffer in use grew, from one capacity to another.
    pub(super) fn count_growth(&mut self, before: usize, after: usize) {
        self.allocations += usize::from(after > before);
    }

    /// Gives a buffer back.
    pub fn give(&mut self, buffer: Vec<T>) {
        self.free.push(buffer);
    }

    /// How often a buffer was asked for.
    pub fn takes(&self) -> usize {
        self.takes
    }

    /// How often one had to be made.
    pub fn allocations(&self) -> usize {
        self.allocations
    }

    /// The memory of the buffers that wait (bytes).
    pub fn bytes(&self) -> usize {
        self.free.iter().map(|buffer| buffer.capacity() * size_of::<T>()).sum()
    }
}
