package io.furrow.connect.sink;

import java.util.Locale;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.ValidString;
import org.apache.kafka.common.config.ConfigDef.Width;

import io.furrow.connect.Recommendations;
import io.furrow.connect.Validators;

/** Which API the context broker is written through. */
record ApiOptions(AbstractConfig config) {
    static final String API = "api";
    static final String CONTEXT = "ngsi.ld.context";
    static final String TIME_METADATA = "time.metadata";

    private static final String V2 = "ngsi-v2";
    private static final String LD = "ngsi-ld";
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_-]{1,256}");

    static void define(ConfigDef options) {
        String group = "API";
        options.define(
                API,
                Type.STRING,
                V2,
                ValidString.in(V2, LD),
                Importance.HIGH,
                "ngsi-v2 writes with POST /v2/op/update; ngsi-ld with POST /ngsi-ld/v1/entityOperations/upsert, for Orion-LD,"
                        + " Scorpio and Stellio.",
                group,
                1,
                Width.SHORT,
                "API",
                java.util.List.of(CONTEXT, TIME_METADATA),
                Recommendations.values(V2, LD));
        options.define(
                CONTEXT,
                Type.STRING,
                "",
                Validators.optionalHttpUrl(),
                Importance.MEDIUM,
                "URL of the @context that names types and attributes, sent as Link header; empty for the core context alone."
                        + " Only with ngsi-ld.",
                group,
                2,
                Width.LONG,
                "@context",
                Recommendations.shownIf(API, LD::equals));
        options.define(
                TIME_METADATA,
                Type.STRING,
                "TimeInstant",
                Validators.matching(NAME, "1 to 256 of A-Z a-z 0-9 _ -"),
                Importance.LOW,
                "Metadata of each attribute that holds its event time, by which the sink knows later what is newer; an IoT"
                        + " Agent writes TimeInstant too. Only with ngsi-v2; NGSI-LD has observedAt.",
                group,
                3,
                Width.MEDIUM,
                "Time metadata",
                Recommendations.shownIf(API, V2::equals, "TimeInstant", "timestamp"));
    }

    ContextBrokerApi api() {
        return config.getString(API).toLowerCase(Locale.ROOT).equals(LD)
                ? new NgsiLd(config.getString(CONTEXT))
                : new NgsiV2(config.getString(TIME_METADATA));
    }
}
