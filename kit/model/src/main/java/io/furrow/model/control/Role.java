package io.furrow.model.control;

import java.util.Optional;

import io.furrow.model.text.Coded;

/** What a caller may do; each may what those before it may. */
public enum Role implements Coded {
    /** Reads, but no credentials. */
    VIEWER,
    /** Commands missions, devices, replays and alarms. */
    OPERATOR,
    /** Reads and rotates credentials, and deletes what others build on. */
    ADMIN;

    /** For annotations of operations that need more than the method of the request says. */
    public static final String ADMINS = "admin";

    public static Optional<Role> of(String code) {
        return Coded.find(values(), code);
    }

    public boolean includes(Role minimum) {
        return compareTo(minimum) >= 0;
    }
}
