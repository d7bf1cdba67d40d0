package io.furrow.connect.source.http;

/** A page served to {@code GET}. */
public record StatusPage(String contentType, byte[] body) {}
