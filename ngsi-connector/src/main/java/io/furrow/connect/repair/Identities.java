package io.furrow.connect.repair;

import io.furrow.model.event.FiwareScope;

/** The inverse of {@link FiwareScope#identity}. */
final class Identities {
    private static final int PARTS = 3;

    private Identities() {}

    static FiwareScope scope(String identity) {
        return FiwareScope.ofIdentity(identity);
    }

    static String id(String identity) {
        return identity.split("\\|", PARTS)[2];
    }
}
