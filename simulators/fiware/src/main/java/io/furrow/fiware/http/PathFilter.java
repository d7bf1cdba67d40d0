package io.furrow.fiware.http;

import java.util.List;

/**
 * The service paths of a request or subscription: {@code /a} for one, {@code /a/#} for it and all below, several
 * separated by commas.
 */
public record PathFilter(List<String> patterns) {
    public static final String EVERYWHERE = "/#";

    public static PathFilter of(String header) {
        return new PathFilter(List.of(header.split("\\s*,\\s*")));
    }

    public boolean isOnePath() {
        return patterns.size() == 1 && !patterns.get(0).endsWith("/#");
    }

    public boolean matches(String servicePath) {
        return patterns.stream().anyMatch(pattern -> matches(pattern, servicePath));
    }

    private static boolean matches(String pattern, String servicePath) {
        if (!pattern.endsWith("/#")) {
            return pattern.equals(servicePath);
        }
        String root = pattern.substring(0, pattern.length() - 2);
        return servicePath.equals(root) || servicePath.startsWith(root + "/");
    }
}
