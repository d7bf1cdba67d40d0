package io.furrow.control.rest.view;

import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.QueryParam;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.event.FiwareScope;

/** Identifies the device of a request: the id of its entity, with tenant, service path and type if the id is ambiguous. */
public final class DeviceName {
    @PathParam("device")
    private String id;

    @QueryParam("service")
    private String service;

    @QueryParam("servicePath")
    private String servicePath;

    @QueryParam("type")
    private String type;

    public String id() {
        return id;
    }

    /** Whether the request names no other type; the case is ignored, because FIROS uses upper case. */
    public boolean isOfType(String existing) {
        return type == null || existing.isEmpty() || type.equalsIgnoreCase(existing);
    }

    /**
     * Returns the key of the device: in the requested scope, else in the only scope that contains the id.
     *
     * @param keys of all devices
     * @param defaultScope scope of devices that are not on a mission
     * @throws ProblemException if several scopes contain the id and the request names none
     */
    public String key(Stream<String> keys, FiwareScope defaultScope) {
        if (service != null || servicePath != null) {
            return FiwareScope.of(
                            service == null ? defaultScope.service() : service,
                            servicePath == null ? defaultScope.servicePath() : servicePath)
                    .identity(id);
        }
        List<String> found = keys.filter(key -> key.endsWith("|" + id)
                        && key.equals(FiwareScope.ofIdentity(key).identity(id)))
                .toList();
        if (found.size() > 1) {
            throw new ProblemException(
                    ErrorCode.AMBIGUOUS_DEVICE,
                    "%d entities have the id '%s'; add ?service=TENANT&servicePath=PATH of one of them: %s"
                            .formatted(
                                    found.size(),
                                    id,
                                    found.stream().map(DeviceName::scope).collect(Collectors.joining(", "))));
        }
        return found.isEmpty() ? defaultScope.identity(id) : found.get(0);
    }

    private static String scope(String key) {
        FiwareScope scope = FiwareScope.ofIdentity(key);
        return "service=%s&servicePath=%s".formatted(scope.service(), scope.servicePath());
    }
}
