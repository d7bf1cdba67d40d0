package io.furrow.control.mission;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.List;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Table;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.Topics;

/**
 * Stores the versions of templates. A version never changes, and its number is never reused.
 *
 * @param templates by {@link MissionTemplate#key()}
 * @param versions by name
 * @param quota for the size of all definitions
 */
record TemplateStore(
        Table<MissionTemplate> templates, Table<Versions> versions, Quota quota, EventPublisher publisher) {
    /** The mission of the thesis: one moving camera, three thermometers and one robot. */
    static final String DEMO = "thesis-demo";

    /**
     * The versions of a template.
     *
     * @param last the last assigned number
     * @param kept numbers of the versions that were not deleted, ascending
     */
    record Versions(int last, List<Integer> kept) {}

    /** Installs {@link #DEMO} unless it ever was. */
    void installBuiltIn() {
        if (versions.get(DEMO) == null) {
            try {
                save(demo());
            } catch (RejectedException e) {
                throw new IllegalStateException("there is no room for the built-in template", e);
            }
        }
    }

    static MissionTemplate demo() {
        try (InputStream json = TemplateStore.class.getResourceAsStream(DEMO + ".json")) {
            return MissionTemplate.read(json.readAllBytes());
        } catch (IOException e) {
            throw new UncheckedIOException("the built-in template cannot be loaded", e);
        } catch (RejectedException e) {
            throw new IllegalStateException("the built-in template cannot be read", e);
        }
    }

    /** Stores the template as its next version and returns that. */
    MissionTemplate save(MissionTemplate template) throws RejectedException {
        Versions before = existing(template.name());
        MissionTemplate saved = template.as(before.last() + 1);
        List<Integer> retained = new ArrayList<>(before.kept());
        retained.add(saved.version());
        byte[] value = saved.toBytes();
        quota.replace(null, value);
        versions.put(saved.name(), new Versions(saved.version(), retained));
        templates.put(saved.key(), saved);
        publisher.put(Topics.TEMPLATES, saved.key(), value);
        return saved;
    }

    /** @param version 0 for the newest */
    MissionTemplate find(String name, int version) throws RejectedException {
        List<Integer> retained = existing(name).kept();
        int desired = version == 0 && !retained.isEmpty() ? retained.get(retained.size() - 1) : version;
        if (!retained.contains(desired)) {
            throw unknown(name, version);
        }
        return templates.get(name + "@" + desired);
    }

    /** Deletes versions; missions that were created from them keep their devices. @param version 0 for all */
    void delete(String name, int version) throws RejectedException {
        Versions before = existing(name);
        if (version == 0 ? before.kept().isEmpty() : !before.kept().contains(version)) {
            throw unknown(name, version);
        }
        List<Integer> retained = new ArrayList<>(before.kept());
        for (int each : before.kept()) {
            if (version == 0 || version == each) {
                retained.remove((Integer) each);
                quota.use(-templates.get(name + "@" + each).toBytes().length);
                templates.put(name + "@" + each, null);
                publisher.put(Topics.TEMPLATES, name + "@" + each, null);
            }
        }
        versions.put(name, new Versions(before.last(), retained));
    }

    private Versions existing(String name) {
        Versions existing = versions.get(name);
        return existing == null ? new Versions(0, List.of()) : existing;
    }

    private static RejectedException unknown(String name, int version) {
        return new RejectedException(
                ErrorCode.UNKNOWN_TEMPLATE,
                "there is no template '%s'".formatted(version == 0 ? name : name + "@" + version));
    }
}
