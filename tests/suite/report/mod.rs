mod page;
mod standard;
