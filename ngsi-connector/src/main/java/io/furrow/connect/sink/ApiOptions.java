package io.furrow.connect.sink;

import java.util.List;
import java.util.Locale;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Validator;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.connect.sink.api.ContextBrokerApi;
import io.furrow.connect.sink.api.NgsiLd;
import io.furrow.connect.sink.api.NgsiV2;

/** Options for the API through which the sink writes to the context broker. */
record ApiOptions(AbstractConfig config) {
    static final String API = "api";
    static final String CONTEXT = "ngsi.ld.context";
    static final String TIME_METADATA = "time.metadata";

    private static final String V2 = "ngsi-v2";
    private static final String LD = "ngsi-ld";
    private static final String NAME = "[A-Za-z0-9_-]{1,256}";

    static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "API");
        group.high()
                .choice(API, List.of(V2, LD), "API")
                .help("ngsi-v2 writes with POST /v2/op/update; ngsi-ld with POST /ngsi-ld/v1/entityOperations/upsert,"
                        + " for Orion-LD, Scorpio and Stellio.");
        group.shownIf(API, LD::equals)
                .text(CONTEXT, "", Validators.optionalHttpUrl(), "@context")
                .help("URL of the @context that names types and attributes, sent as Link header; empty for the core"
                        + " context alone. Only with ngsi-ld.");
        Validator metadata = Validators.matching(NAME, "1 to 256 of A-Z a-z 0-9 _ -");
        group.low()
                .shownIf(API, V2::equals)
                .recommending("TimeInstant", "timestamp")
                .text(TIME_METADATA, "TimeInstant", metadata, "Time metadata")
                .help("Metadata of each attribute that holds its event time, by which the sink later determines the"
                        + " newer value; an IoT Agent writes TimeInstant too. Only with ngsi-v2; NGSI-LD has"
                        + " observedAt.");
    }

    ContextBrokerApi api() {
        return config.getString(API).toLowerCase(Locale.ROOT).equals(LD)
                ? new NgsiLd(config.getString(CONTEXT))
                : new NgsiV2(config.getString(TIME_METADATA));
    }
}
