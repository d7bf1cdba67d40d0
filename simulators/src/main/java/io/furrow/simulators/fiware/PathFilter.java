package io.furrow.simulators.fiware;

import java.util.List;

/**
 * The service paths that a request or subscription looks at: {@code /a} that one, {@code /a/#} that one and all below,
 * several parted by commas.
 */
record PathFilter(List<String> patterns) {
    static final String EVERYWHERE = "/#";

    static PathFilter of(String header) {
        return new PathFilter(List.of(header.split("\\s*,\\s*")));
    }

    boolean isOnePath() {
        return patterns.size() == 1 && !patterns.get(0).endsWith("/#");
    }

    boolean matches(String servicePath) {
        for (String pattern : patterns) {
            if (matches(pattern, servicePath)) {
                return true;
            }
        }
        return false;
    }

    private static boolean matches(String pattern, String servicePath) {
        if (!pattern.endsWith("/#")) {
            return pattern.equals(servicePath);
        }
        String root = pattern.substring(0, pattern.length() - 2);
        return servicePath.equals(root) || servicePath.startsWith(root + "/");
    }
}
