package io.furrow.control.rest;

import java.util.Locale;
import java.util.Optional;

import jakarta.annotation.security.RolesAllowed;

/** What a caller may do; each may what those before it may. */
enum Role {
    /** Reads, but no credentials. */
    VIEWER,
    /** Commands missions, devices, replays and alarms. */
    OPERATOR,
    /** Reads and rotates credentials, and deletes what others build on. */
    ADMIN;

    /** For {@link RolesAllowed}: operations that need more than the method of the request says, see {@link RoleFilter}. */
    static final String ADMINS = "admin";

    static Optional<Role> of(String word) {
        for (Role role : values()) {
            if (role.word().equals(word)) {
                return Optional.of(role);
            }
        }
        return Optional.empty();
    }

    /** As in the file of tokens. */
    String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    boolean includes(Role least) {
        return compareTo(least) >= 0;
    }
}
