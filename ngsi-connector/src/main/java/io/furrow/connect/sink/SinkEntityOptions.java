package io.furrow.connect.sink;

import java.util.List;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Validator;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.model.event.FiwareScope;

/** Options for the entities of records and the records that are skipped. */
final class SinkEntityOptions {
    static final String SERVICE = "fiware.service";
    static final String SERVICE_PATH = "fiware.servicepath";
    static final String DEFAULT_TYPE = "entity.type";
    static final String DELETE_ON_NULL = "delete.on.null";
    static final String ECHO_SOURCES = "echo.sources";

    private static final String TYPE = "[^\\s&?/#<>\"'=;()]{0,256}";

    private final AbstractConfig config;
    private final List<Pattern> echoSources;

    SinkEntityOptions(AbstractConfig config) {
        this.config = config;
        this.echoSources =
                config.getList(ECHO_SOURCES).stream().map(Pattern::compile).toList();
    }

    static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Entities");
        Validator tenant = Validators.matching(ChangeReader.SERVICE.pattern(), "at most 50 of a-z 0-9 _");
        group.text(SERVICE, "", tenant, "Tenant")
                .help("Tenant (Fiware-Service) of records without a header fiware-service; empty for the default"
                        + " tenant.");
        Validator path =
                Validators.matching(ChangeReader.SERVICE_PATH.pattern(), "a path of A-Z a-z 0-9 _ that begins with /");
        group.text(SERVICE_PATH, "/", path, "Service path")
                .help("Service path (Fiware-Servicepath) of records without a header fiware-servicepath.");
        Validator type = Validators.matching(TYPE, "at most 256 characters that are allowed in a type");
        group.low()
                .text(DEFAULT_TYPE, "", type, "Default type")
                .help("Type of entities without one; empty for Thing, the default of context brokers. A struct without"
                        + " a field type uses the last part of its schema's name.");
        defineSkipped(group);
    }

    private static void defineSkipped(OptionGroup group) {
        group.flag(DELETE_ON_NULL, false, "Delete on null")
                .help(
                        "Whether a tombstone deletes the entity whose id is its key and whose type is in the header entity-type, if"
                                + " it has one, unless a newer value is known."
                                + " Otherwise tombstones are skipped.");
        group.list(ECHO_SOURCES, "/ngsi/.*", Validators.patterns(), "Echo sources")
                .help("Regular expressions; a record whose header ce_source matches one as a whole came from a context"
                        + " broker and is skipped, because writing it back would make the broker notify it again,"
                        + " forever. Set it to the sources that read this very broker, or leave it empty, to copy one"
                        + " broker to another.");
    }

    /** The scope of records without headers. */
    FiwareScope scope() {
        return FiwareScope.of(config.getString(SERVICE), config.getString(SERVICE_PATH));
    }

    String defaultType() {
        return config.getString(DEFAULT_TYPE);
    }

    boolean deletesOnNull() {
        return config.getBoolean(DELETE_ON_NULL);
    }

    /** Whether a record with this {@code ce_source} is skipped. */
    boolean isEcho(String source) {
        return !source.isEmpty()
                && echoSources.stream()
                        .anyMatch(pattern -> pattern.matcher(source).matches());
    }
}
