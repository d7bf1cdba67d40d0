package io.furrow.connect.repair;

import io.furrow.model.event.FiwareScope;

/** The inverse of {@link FiwareScope#identity}. */
final class Identities {
    private static final int PARTS = 3;

    private Identities() {}

    static FiwareScope scope(String identity) {
        String[] parts = identity.split("\\|", PARTS);
        return new FiwareScope(plain(parts[0]), plain(parts[1]));
    }

    static String id(String identity) {
        return identity.split("\\|", PARTS)[2];
    }

    private static String plain(String escaped) {
        return escaped.replace("%7C", "|").replace("%25", "%");
    }
}
