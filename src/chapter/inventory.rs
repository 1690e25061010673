//! A row for each equation, listing, figure, note and claim of the chapter.
