package io.furrow.connect.source.option;

import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.Set;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.subscription.DesiredSubscription.Throttling;
import io.furrow.connect.subscription.NotificationContent;
import io.furrow.connect.subscription.Subject;

/** Options for the subscriptions that the source creates and manages. */
public record SubscriptionOptions(AbstractConfig config) {
    public static final String ENABLED = "subscription.enabled";
    static final String PUBLIC_URL = "public.url";
    static final String DESCRIPTION = "subscription.description";
    static final String TENANTS = "subscription.tenants";
    static final String SERVICE_PATHS = "subscription.servicepaths";
    static final String TYPES = "subscription.types";
    static final String TYPE_PATTERN = "subscription.type.pattern";
    static final String ID_PATTERN = "subscription.id.pattern";
    static final String ATTRS = "subscription.attrs";
    static final String METADATA = "subscription.metadata";
    static final String ATTRS_FORMAT = "subscription.attrs.format";
    static final String ONLY_CHANGED = "subscription.only.changed.attrs";
    static final String ALTERATION_TYPES = "subscription.alteration.types";
    static final String THROTTLING = "subscription.throttling.s";
    static final String EXPIRY = "subscription.expiry.ms";
    static final String MAX_FAILS = "subscription.max.fails";
    static final String CHECK_INTERVAL = "subscription.check.interval.ms";

    private static final String DELETED = "entityDelete";
    private static final String ALTERATION = "alterationType";
    private static final List<String> FORMATS =
            List.of("normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues");
    private static final List<String> ALTERATIONS = List.of("entityCreate", "entityChange", "entityUpdate", DELETED);
    private static final String ANY_ID = ".*";
    private static final String METADATA_NAME = "[!-~&&[^<>\"'=;()&?/#,]]{1,256}";

    /** Checks constraints between options. */
    public SubscriptionOptions {
        if (!config.getList(TYPES).isEmpty() && !config.getString(TYPE_PATTERN).isEmpty()) {
            throw new ConfigException(TYPE_PATTERN, config.getString(TYPE_PATTERN), "excludes " + TYPES);
        }
        String format = config.getString(ATTRS_FORMAT);
        if (!config.getList(METADATA).isEmpty()
                && format.toLowerCase(Locale.ROOT).endsWith("keyvalues")) {
            throw new ConfigException(
                    METADATA,
                    config.getList(METADATA),
                    format + " carries no metadata; set " + ATTRS_FORMAT + "=normalized or leave this empty");
        }
    }

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Subscription").shownIf(BrokerOptions.URL, url -> !url.isEmpty());
        group.flag(ENABLED, true, "Keep")
                .help("Whether the source creates its own subscriptions at " + BrokerOptions.URL + " and manages them"
                        + " as configured here. Without that URL it never does.");
        Validator url = Validators.matching("|https?://[^\\s]+", "empty, http://HOST:PORT/PATH or https://…");
        group.text(PUBLIC_URL, "", url, "Own address")
                .help("Address of this source as the context broker reaches it; {port} stands for the port of the task."
                        + " Empty for http://" + ListeningOptions.HOST + ":{port}/v2/notify, https if the listener has"
                        + " a key store. If each worker has its own address, take it from each worker's environment"
                        + " with a config provider, for instance http://${env:POD_IP}:{port}/v2/notify.");
        Validator description =
                Validators.matching("[^<>\"'=;()]{0,900}", "at most 900 characters without < > \" ' = ; ( )");
        group.text(DESCRIPTION, "", description, "Description")
                .help("Description by which the source finds its subscription, followed by the number of the task, for"
                        + " instance 1/1; empty for furrow and the connector's name. Must be unique per context"
                        + " broker.");
        defineSubject(group);
        defineContent(group);
        definePace(group);
    }

    private static void defineSubject(OptionGroup group) {
        Validator tenants = Validators.names("[A-Za-z0-9_]{1,50}|-", "tenants, - for the one without a name");
        group.list(TENANTS, SecurityOptions.NO_TENANT, tenants, "Tenants")
                .help("Tenants (fiware-service) to subscribe in, " + SecurityOptions.NO_TENANT + " for the one without"
                        + " a name.");
        Validator paths = Validators.names("/#|/|(/[A-Za-z0-9_]{1,50}){1,10}(/#)?", "absolute service paths");
        group.list(SERVICE_PATHS, "/#", paths, "Service paths")
                .help("Service paths to subscribe to, one subscription each; /# at the end includes the paths below.");
        group.list(TYPES, "", Validators.names("\\S+", "entity types"), "Types").help("Entity types; empty for all.");
        group.text(TYPE_PATTERN, "", Validators.pattern(), "Pattern of types")
                .help("Regular expression that is found in the entity type; empty for any. Not together with " + TYPES
                        + ".");
        group.text(ID_PATTERN, ANY_ID, Validators.pattern(), "Pattern of ids")
                .help("Regular expression that is found in the entity id. Only with tasks.max=1: several tasks divide"
                        + " the ids among them by their last character.");
        Validator alterations = Validators.names(String.join("|", ALTERATIONS), String.join(", ", ALTERATIONS));
        group.list(ALTERATION_TYPES, "", alterations, "Alterations")
                .help("Alterations that are notified, of " + String.join(", ", ALTERATIONS) + "; empty for created and"
                        + " changed. A deletion becomes a record without a value. Needs Orion 3.7 or later.");
    }

    private static void defineContent(OptionGroup group) {
        group.list(ATTRS, "*,dateModified", Validators.names("\\S+", "attributes"), "Attributes")
                .help("Attributes in a notification; * for all of the entity's own. " + ALTERATION + " is added if"
                        + " deletions are notified. Keep dateModified: it is the event time if the entity has none.");
        Validator metadata =
                Validators.names(METADATA_NAME, "metadata, of visible ASCII without < > \" ' = ; ( ) & ? / #");
        group.list(METADATA, "", metadata, "Metadata")
                .help("Metadata of the attributes in a notification, and in what is repaired; empty for all of their"
                        + " own, such as TimeInstant. With names only these are notified, * again for all of their own:"
                        + " *,dateModified adds the time at which the context broker stored each attribute."
                        + " previousValue and actionType are of notifications only.");
        group.low().choice(ATTRS_FORMAT, FORMATS, "Format").help("Form of the entities in a notification.");
        group.flag(ONLY_CHANGED, false, "Only changed")
                .help("Whether a notification holds only the attributes that changed. Repaired entities hold all of"
                        + " them.");
    }

    private static void definePace(OptionGroup group) {
        group.low()
                .number(THROTTLING, 0, Range.between(0, 86_400), "Throttling (s)")
                .help("Minimum seconds between two notifications of a subscription. Changes in between are never"
                        + " notified or repaired. Leave it at 0 unless samples are sufficient.");
        group.low()
                .number(EXPIRY, 0, Range.atLeast(0), "Expiry (ms)")
                .help("Milliseconds until a subscription expires; it is renewed after half of them, so that it expires"
                        + " some time after the source has stopped. 0 for one that never expires. At least 60000 makes"
                        + " sense.");
        group.low()
                .number(MAX_FAILS, 0, Range.between(0, 1_000_000), "Failures")
                .help("Failures in a row after which the context broker stops a subscription, so that it does not"
                        + " notify a source that is unavailable; the source restarts it. 0 for never.");
        group.low()
                .number(CHECK_INTERVAL, 10_000, Range.between(100, 600_000), "Looks (ms)")
                .help("Milliseconds between two polls of a subscription: how fast one that was changed, removed or"
                        + " stopped is restored, and a gap is found.");
    }

    public boolean enabled() {
        return config.getBoolean(ENABLED)
                && !config.getString(BrokerOptions.URL).isEmpty();
    }

    /** @param connector its name */
    public String description(String connector) {
        String own = config.getString(DESCRIPTION);
        return own.isEmpty() ? "furrow " + connector : own;
    }

    /** In lower case, the empty text for the default tenant. */
    public List<String> tenants() {
        return config.getList(TENANTS).stream()
                .map(tenant -> tenant.equals(SecurityOptions.NO_TENANT) ? "" : tenant.toLowerCase(Locale.ROOT))
                .distinct()
                .toList();
    }

    public List<String> servicePaths() {
        return config.getList(SERVICE_PATHS).stream().distinct().toList();
    }

    /** @throws ConfigException if ids are selected by a pattern, which several tasks cannot divide */
    public void requireAnyId() {
        if (!config.getString(ID_PATTERN).equals(ANY_ID)) {
            throw new ConfigException(
                    ID_PATTERN,
                    config.getString(ID_PATTERN),
                    "several tasks divide the ids by their last character; set tasks.max=1 or leave it at " + ANY_ID);
        }
    }

    /** @throws ConfigException if senders cannot reach the listen address and no public address is configured */
    public void requireAddress(String host) {
        if (config.getString(PUBLIC_URL).isEmpty()
                && Set.of("0.0.0.0", "::", "[::]").contains(host)) {
            throw new ConfigException(
                    PUBLIC_URL,
                    "",
                    "the source listens on all addresses (" + host + "); set the one that the context broker uses");
        }
    }

    /** @param share the pattern of a task's part of the ids, used if there are several tasks */
    public Subject subject(Optional<String> share) {
        return new Subject(
                share.orElse(config.getString(ID_PATTERN)),
                config.getList(TYPES),
                Optional.of(config.getString(TYPE_PATTERN)).filter(pattern -> !pattern.isEmpty()),
                config.getList(ALTERATION_TYPES));
    }

    public NotificationContent content() {
        List<String> attrs = new java.util.ArrayList<>(config.getList(ATTRS));
        if (config.getList(ALTERATION_TYPES).contains(DELETED) && !attrs.contains(ALTERATION)) {
            if (attrs.isEmpty()) {
                attrs.add("*");
            }
            attrs.add(ALTERATION);
        }
        return new NotificationContent(
                attrs, config.getList(METADATA), config.getString(ATTRS_FORMAT), config.getBoolean(ONLY_CHANGED));
    }

    public Throttling pace() {
        return new Throttling(
                Duration.ofSeconds(config.getLong(THROTTLING)),
                Optional.of(Duration.ofMillis(config.getLong(EXPIRY))).filter(life -> !life.isZero()));
    }

    public Optional<Integer> maxFails() {
        return Optional.of(config.getLong(MAX_FAILS).intValue()).filter(limit -> limit > 0);
    }

    public Duration checkInterval() {
        return Duration.ofMillis(config.getLong(CHECK_INTERVAL));
    }

    /** @param http the protocol of the listener, {@code http} or {@code https} */
    public String url(String http, String host, int port) {
        String own = config.getString(PUBLIC_URL);
        String url = own.isEmpty() ? http + "://" + host + ":{port}/v2/notify" : own;
        return url.replace("{port}", Integer.toString(port));
    }
}
