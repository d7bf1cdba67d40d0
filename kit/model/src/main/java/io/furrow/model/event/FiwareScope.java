package io.furrow.model.event;

import java.util.Map;

/**
 * The tenant and service path of an entity. The same id in two scopes, or with two types in one scope, identifies two
 * entities.
 *
 * @param service header {@code fiware-service}, lower case; empty for the default tenant
 * @param servicePath header {@code fiware-servicepath}, {@code /} for the root
 */
public record FiwareScope(String service, String servicePath) {
    public static final FiwareScope DEFAULT = new FiwareScope("", "/");

    /** Returns the scope of two headers; each may be null or blank. {@code /farm/} is the same path as {@code /farm}. */
    public static FiwareScope of(String service, String servicePath) {
        String tenant = service == null ? "" : service.trim().toLowerCase(java.util.Locale.ROOT);
        String path = servicePath == null || servicePath.isBlank() ? "/" : servicePath.trim();
        boolean isList = path.indexOf(',') >= 0; // of several entities, see NotificationRules
        while (!isList && path.length() > 1 && path.endsWith("/")) {
            path = path.substring(0, path.length() - 1);
        }
        return new FiwareScope(tenant, path);
    }

    /** Returns the scope of a record's headers. */
    public static FiwareScope of(Map<String, String> headers) {
        return of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
    }

    /** Returns tenant, service path and id as one text: the key of a device on {@code service.devices}. */
    public String identity(String entityId) {
        return escape(service) + "|" + escape(servicePath) + "|" + entityId;
    }

    /** Returns the identity of an entity with its type, because entities of several types may share an id. */
    public String identity(String type, String entityId) {
        return escape(service) + "|" + escape(servicePath) + "|" + escape(type) + "|" + entityId;
    }

    /** Returns the scope of an {@link #identity}. */
    public static FiwareScope ofIdentity(String identity) {
        String[] parts = identity.split("\\|", 3);
        return new FiwareScope(unescape(parts[0]), unescape(parts[1]));
    }

    /** Returns the type in an identity of this entity id; empty if it has none. */
    public static String typeOf(String identity, String entityId) {
        String rest = identity.split("\\|", 3)[2];
        int end = rest.length() - entityId.length() - 1;
        return end < 0 ? "" : unescape(rest.substring(0, end));
    }

    /** Escapes characters that the context broker does not allow but headers may contain. */
    private static String escape(String part) {
        return part.replace("%", "%25").replace("|", "%7C");
    }

    private static String unescape(String escaped) {
        return escaped.replace("%7C", "|").replace("%25", "%");
    }
}
