package io.furrow.connect.source;

/** Something to look at with {@code GET}. */
record Page(String contentType, byte[] body) {}
