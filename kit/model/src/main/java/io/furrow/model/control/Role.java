package io.furrow.model.control;

import java.util.Optional;

import io.furrow.model.text.Coded;

/** The roles of callers; each role includes those before it. */
public enum Role implements Coded {
    /** Reads everything except credentials and dead letters. */
    VIEWER,
    /** Commands missions, devices, replays and alarms, reads and redrives dead letters. */
    OPERATOR,
    /** Reads and rotates credentials, and deletes domains and templates. */
    ADMIN;

    /** Role name in annotations of operations that need more than the request method implies. */
    public static final String ADMINS = "admin";

    public static final String OPERATORS = "operator";

    public static Optional<Role> of(String code) {
        return Coded.find(values(), code);
    }

    public boolean includes(Role minimum) {
        return compareTo(minimum) >= 0;
    }
}
