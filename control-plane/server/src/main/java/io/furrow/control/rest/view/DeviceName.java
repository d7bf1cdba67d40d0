package io.furrow.control.rest.view;

import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.QueryParam;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.event.FiwareScope;

/** The device that a request is about: the id of its entity, and where one id is several entities, which of them. */
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

    /** Whether no other type is asked for; robots of FIROS write theirs in upper case. */
    public boolean isOfType(String existing) {
        return type == null || existing.isEmpty() || type.equalsIgnoreCase(existing);
    }

    /**
     * The key of the device: in the scope that the request names, else in the only one that has the id.
     *
     * @param keys of all devices
     * @param usual where a device is that is on no mission
     * @throws ProblemException where several have the id and the request names no scope
     */
    public String key(Stream<String> keys, FiwareScope usual) {
        if (service != null || servicePath != null) {
            return FiwareScope.of(
                            service == null ? usual.service() : service,
                            servicePath == null ? usual.servicePath() : servicePath)
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
        return found.isEmpty() ? usual.identity(id) : found.get(0);
    }

    private static String scope(String key) {
        FiwareScope scope = FiwareScope.ofIdentity(key);
        return "service=%s&servicePath=%s".formatted(scope.service(), scope.servicePath());
    }
}
