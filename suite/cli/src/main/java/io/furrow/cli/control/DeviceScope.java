package io.furrow.cli.control;

import java.util.LinkedHashMap;
import java.util.Map;

import picocli.CommandLine.Option;

import io.furrow.cli.control.client.ControlApi;

/** Selects one of several entities with the same id. */
final class DeviceScope {
    @Option(
            names = "--fiware-service",
            paramLabel = "TENANT",
            description = "Tenant of its entity; required if several tenants or service paths have the id.")
    private String service;

    @Option(names = "--fiware-service-path", paramLabel = "PATH", description = "Service path of its entity.")
    private String servicePath;

    /** The query for the REST API; empty if no option is given. */
    String query() {
        Map<String, String> query = new LinkedHashMap<>();
        query.put("service", service);
        query.put("servicePath", servicePath);
        return ControlApi.query(query);
    }
}
