package io.furrow.control.rest.access;

import java.util.Locale;
import java.util.Optional;

import jakarta.annotation.security.RolesAllowed;

/** What a caller may do; each may what those before it may. */
public enum Role {
    /** Reads, but no credentials. */
    VIEWER,
    /** Commands missions, devices, replays and alarms. */
    OPERATOR,
    /** Reads and rotates credentials, and deletes what others build on. */
    ADMIN;

    /** For {@link RolesAllowed}: operations that need more than the method of the request says, see {@link RoleFilter}. */
    public static final String ADMINS = "admin";

    public static Optional<Role> of(String code) {
        for (Role role : values()) {
            if (role.code().equals(code)) {
                return Optional.of(role);
            }
        }
        return Optional.empty();
    }

    /** As in the file of tokens. */
    public String code() {
        return name().toLowerCase(Locale.ROOT);
    }

    public boolean includes(Role minimum) {
        return compareTo(minimum) >= 0;
    }
}
