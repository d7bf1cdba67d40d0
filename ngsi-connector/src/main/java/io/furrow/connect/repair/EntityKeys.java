package io.furrow.connect.repair;

import io.furrow.model.event.FiwareScope;

/** The inverse of {@link FiwareScope#identity(String, String)}. */
final class EntityKeys {
    private static final int PARTS = 4;
    private static final int TYPE = 2;

    private EntityKeys() {}

    static FiwareScope scope(String identity) {
        return FiwareScope.ofIdentity(identity);
    }

    static String type(String identity) {
        return identity.split("\\|", PARTS)[TYPE].replace("%7C", "|").replace("%25", "%");
    }

    static String id(String identity) {
        return identity.split("\\|", PARTS)[PARTS - 1];
    }
}
