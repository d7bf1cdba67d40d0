package io.furrow.dashboard.auth;

import io.furrow.model.control.Role;

/** A user of the dashboard. @param name as on the audit topic */
public record User(String name, Role role) {}
