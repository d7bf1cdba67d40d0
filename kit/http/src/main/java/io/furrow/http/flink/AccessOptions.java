package io.furrow.http.flink;

import java.util.List;

import org.apache.flink.configuration.ConfigOption;
import org.apache.flink.configuration.ConfigOptions;

/** Options in Flink's configuration that control access to its REST API and web UI. */
public final class AccessOptions {
    /** Further hosts of the REST API. */
    public static final ConfigOption<List<String>> ALLOWED_HOSTS = ConfigOptions.key("furrow.http.allowed-hosts")
            .stringType()
            .asList()
            .defaultValues()
            .withDescription(
                    "Hosts by which the REST API is reached, beside loopback, rest.address and rest.bind-address.");

    /** Origins of pages that may use the REST API. */
    public static final ConfigOption<List<String>> ALLOWED_ORIGINS = ConfigOptions.key("furrow.http.allowed-origins")
            .stringType()
            .asList()
            .defaultValues()
            .withDescription(
                    "Origins of the pages that may use the REST API, beside the web UI's own. It takes the place of"
                            + " web.access-control-allow-origin.");

    /** Whether the REST API is read-only. */
    public static final ConfigOption<Boolean> READ_ONLY = ConfigOptions.key("furrow.http.read-only")
            .booleanType()
            .defaultValue(false)
            .withDescription(
                    "Whether the REST API refuses all that changes the cluster: jars, jobs, savepoints, cancelling."
                            + " flink run, stop and cancel need it off.");

    private AccessOptions() {}
}
