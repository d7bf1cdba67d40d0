package io.furrow.connect.source.http;

/** A page served to {@code GET}. */
public record Page(String contentType, byte[] body) {}
