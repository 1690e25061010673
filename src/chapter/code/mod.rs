//! The chapter's listings as printed (`printed`), each beside its corrected form (`corrected`).
