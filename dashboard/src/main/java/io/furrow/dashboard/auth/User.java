package io.furrow.dashboard.auth;

/** @param name as on the audit topic */
public record User(String name, UserRole role) {}
