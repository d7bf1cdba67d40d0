package io.furrow.connect.repair.entity;

import io.furrow.model.event.FiwareScope;

/** The inverse of {@link FiwareScope#identity}. */
public final class Identities {
    private static final int PARTS = 3;

    private Identities() {}

    public static FiwareScope scope(String identity) {
        return FiwareScope.ofIdentity(identity);
    }

    public static String id(String identity) {
        return identity.split("\\|", PARTS)[2];
    }
}
