package io.furrow.connect.sink;

import java.util.List;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

import io.furrow.connect.Recommendations;
import io.furrow.connect.Validators;
import io.furrow.model.event.FiwareScope;

/** Which entities the records are about, and which records are left out. */
final class SinkEntityOptions {
    static final String SERVICE = "fiware.service";
    static final String SERVICE_PATH = "fiware.servicepath";
    static final String DEFAULT_TYPE = "entity.type";
    static final String DELETE_ON_NULL = "delete.on.null";
    static final String ECHO_SOURCES = "echo.sources";

    private static final Pattern TYPE = Pattern.compile("[^\\s&?/#<>\"'=;()]{0,256}");

    private final AbstractConfig config;
    private final List<Pattern> echoSources;

    SinkEntityOptions(AbstractConfig config) {
        this.config = config;
        this.echoSources =
                config.getList(ECHO_SOURCES).stream().map(Pattern::compile).toList();
    }

    static void define(ConfigDef options) {
        String group = "Entities";
        options.define(
                SERVICE,
                Type.STRING,
                "",
                Validators.matching(ChangeReader.SERVICE, "at most 50 of a-z 0-9 _"),
                Importance.MEDIUM,
                "Tenant (Fiware-Service) of records without a header fiware-service; empty for the default tenant.",
                group,
                1,
                Width.MEDIUM,
                "Tenant");
        options.define(
                SERVICE_PATH,
                Type.STRING,
                "/",
                Validators.matching(ChangeReader.SERVICE_PATH, "a path of A-Z a-z 0-9 _ that begins with /"),
                Importance.MEDIUM,
                "Service path (Fiware-Servicepath) of records without a header fiware-servicepath.",
                group,
                2,
                Width.MEDIUM,
                "Service path");
        options.define(
                DEFAULT_TYPE,
                Type.STRING,
                "",
                Validators.matching(TYPE, "at most 256 signs that a type may have"),
                Importance.LOW,
                "Type of entities that name none; empty for Thing, as context brokers have it. A struct without a field type"
                        + " has the last part of its schema's name.",
                group,
                3,
                Width.MEDIUM,
                "Default type");
        defineLeftOut(options, group);
    }

    private static void defineLeftOut(ConfigDef options, String group) {
        options.define(
                DELETE_ON_NULL,
                Type.BOOLEAN,
                false,
                Validators.truth(),
                Importance.MEDIUM,
                "Whether a record without value deletes the entity whose id is its key, unless something newer is known of"
                        + " it. Otherwise such records are left out.",
                group,
                4,
                Width.SHORT,
                "Delete on null",
                Recommendations.values(true, false));
        options.define(
                ECHO_SOURCES,
                Type.LIST,
                "/ngsi/.*",
                Validators.patterns(),
                Importance.MEDIUM,
                "Regular expressions; a record whose header ce_source matches one as a whole came from a context broker and is"
                        + " left out, because writing it back would make the broker report it again, for ever. Set it to"
                        + " the sources that read this very broker, or to nothing, to copy one broker to another.",
                group,
                5,
                Width.LONG,
                "Echo sources");
    }

    /** Where records without headers belong. */
    FiwareScope scope() {
        return FiwareScope.of(config.getString(SERVICE), config.getString(SERVICE_PATH));
    }

    String defaultType() {
        return config.getString(DEFAULT_TYPE);
    }

    boolean deletesOnNull() {
        return config.getBoolean(DELETE_ON_NULL);
    }

    /** Whether a record of this {@code ce_source} is left out. */
    boolean isEcho(String source) {
        if (source.isEmpty()) {
            return false;
        }
        for (Pattern pattern : echoSources) {
            if (pattern.matcher(source).matches()) {
                return true;
            }
        }
        return false;
    }
}
