mod friction;
mod page;
mod standard;
