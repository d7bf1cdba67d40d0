package io.furrow.model.event;

import java.util.Map;

/**
 * Where an entity lives in the context broker: its tenant and service path. The same id in two scopes, or with two types in one, is
 * two entities.
 *
 * @param service header {@code fiware-service}, lower case; empty for the default tenant
 * @param servicePath header {@code fiware-servicepath}, {@code /} for the root
 */
public record FiwareScope(String service, String servicePath) {
    public static final FiwareScope DEFAULT = new FiwareScope("", "/");

    /** The scope that two headers name; each may be null or blank. */
    public static FiwareScope of(String service, String servicePath) {
        String tenant = service == null ? "" : service.trim().toLowerCase(java.util.Locale.ROOT);
        String path = servicePath == null || servicePath.isBlank() ? "/" : servicePath.trim();
        return new FiwareScope(tenant, path);
    }

    /** The scope that the headers of a record name. */
    public static FiwareScope of(Map<String, String> headers) {
        return of(headers.get(HeaderNames.SERVICE), headers.get(HeaderNames.SERVICE_PATH));
    }

    /** Tenant, service path and id in one text: the key of a device on {@code service.devices}, whatever its type. */
    public String identity(String entityId) {
        return escaped(service) + "|" + escaped(servicePath) + "|" + entityId;
    }

    /** The same of an entity: an id alone is not unique, entities of several types may share one. */
    public String identity(String type, String entityId) {
        return escaped(service) + "|" + escaped(servicePath) + "|" + escaped(type) + "|" + entityId;
    }

    /** The scope of which {@link #identity} made this text. */
    public static FiwareScope ofIdentity(String identity) {
        String[] parts = identity.split("\\|", 3);
        return new FiwareScope(plain(parts[0]), plain(parts[1]));
    }

    /** The type in an identity of this entity id; empty where the identity has none. */
    public static String typeOf(String identity, String entityId) {
        String rest = identity.split("\\|", 3)[2];
        int end = rest.length() - entityId.length() - 1;
        return end < 0 ? "" : plain(rest.substring(0, end));
    }

    /** The context broker allows neither sign, but a header may hold anything. */
    private static String escaped(String part) {
        return part.replace("%", "%25").replace("|", "%7C");
    }

    private static String plain(String escaped) {
        return escaped.replace("%7C", "|").replace("%25", "%");
    }
}
