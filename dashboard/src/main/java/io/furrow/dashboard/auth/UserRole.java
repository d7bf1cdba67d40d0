package io.furrow.dashboard.auth;

import java.util.Locale;

/** As the control plane's; each may what those before it may. */
public enum UserRole {
    VIEWER,
    OPERATOR,
    ADMIN;

    static UserRole of(String word) {
        return valueOf(word.toUpperCase(Locale.ROOT));
    }

    public boolean includes(UserRole least) {
        return compareTo(least) >= 0;
    }

    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }
}
