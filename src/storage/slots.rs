//! Slots of equal size in one buffer that refer to each other by number: the entries of the list.
//!
//! Freed slots are reused, and clearing keeps the buffer: the chapter's memory pool where it is
//! most useful.

/// The number that means no slot.
pub(super) const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slots<T> {
    items: Vec<T>,
    free: Vec<u32>,
    allocations: usize,
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Slots { items: Vec::new(), free: Vec::new(), allocations: 0 }
    }
}

impl<T> Slots<T> {
    /// Puts an item into a free slot.
    pub(super) fn add(&mut self, item: T) -> u32 {
        if let Some(slot) = self.free.pop() {
            self.items[slot as usize] = item;
            return slot;
        }
        self.allocations += usize::from(self.items.len() == self.items.capacity());
        self.items.push(item);
        (self.items.len() - 1) as u32
    }

    /// Frees a slot.
    pub(super) fn remove(&mut self, slot: u32) {
        self.allocations += usize::from(self.free.len() == self.free.capacity());
        self.free.push(slot);
    }

    /// Frees all slots, keeping the memory.
    pub(super) fn clear(&mut self) {
        self.items.clear();
        self.free.clear();
    }

    /// Reserves exactly this number of items, unless there is enough capacity.
    pub(super) fn reserve(&mut self, items: usize) {
        if items > self.items.capacity() {
            self.allocations += 1;
            self.items.reserve_exact(items - self.items.len());
        }
    }

    /// The number of slots in use.
    pub(super) fn len(&self) -> usize {
        self.items.len() - self.free.len()
    }

    pub(super) fn bytes(&self) -> usize {
        self.items.capacity() * size_of::<T>() + self.free.capacity() * size_of::<u32>()
    }

    pub(super) fn allocations(&self) -> usize {
        self.allocations
    }

    /// The item in a slot; `None` for [`NONE`].
    pub(super) fn at(&self, slot: u32) -> Option<&T> {
        self.items.get(slot as usize)
    }

    pub(super) fn at_mut(&mut self, slot: u32) -> Option<&mut T> {
        self.items.get_mut(slot as usize)
    }
}
