package io.furrow.cli.control;

import java.net.URLEncoder;
import java.nio.charset.StandardCharsets;
import java.util.StringJoiner;

import picocli.CommandLine.Option;

/** Which of several entities of one id a device is. */
final class DeviceScope {
    @Option(
            names = "--fiware-service",
            paramLabel = "TENANT",
            description = "Tenant of its entity; required if several tenants or service paths have the id.")
    private String service;

    @Option(names = "--fiware-service-path", paramLabel = "PATH", description = "Service path of its entity.")
    private String servicePath;

    /** For the REST API; empty if neither is given. */
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
