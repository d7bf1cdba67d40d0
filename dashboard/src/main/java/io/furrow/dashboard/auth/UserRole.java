package io.furrow.dashboard.auth;

import java.util.Locale;

/** As the control plane's; each may what those before it may. */
public enum UserRole {
    VIEWER,
    OPERATOR,
    ADMIN;

    static UserRole of(String code) {
        return valueOf(code.toUpperCase(Locale.ROOT));
    }

    public boolean includes(UserRole minimum) {
        return compareTo(minimum) >= 0;
    }

    public String code() {
        return name().toLowerCase(Locale.ROOT);
    }
}
