package io.furrow.cli.control;

import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.util.StringJoiner;

import picocli.CommandLine.Option;

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
        StringJoiner query = new StringJoiner("&", "?", "").setEmptyValue("");
        add(query, "service", service);
        add(query, "servicePath", servicePath);
        return query.toString();
    }

    private static void add(StringJoiner query, String name, String value) {
        if (value != null) {
            query.add(name + "=" + URLEncoder.encode(value, StandardCharsets.UTF_8));
        }
    }
}
