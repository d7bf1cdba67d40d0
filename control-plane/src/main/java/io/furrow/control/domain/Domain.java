package io.furrow.control.domain;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.control.manager.StateJson;
import io.furrow.model.control.DomainDetails;

/**
 * A domain as it is remembered, and a record of {@code service.domains} under its name. What is not said is null.
 *
 * @param domain its name in topics
 * @param name for people
 * @param area GeoJSON; owned by the domain
 * @param fields ids of fields
 * @param created when, epoch ms
 * @param changed when last, epoch ms
 * @param sequence grows with every change of anything that is wanted
 */
public record Domain(
        String domain,
        String name,
        String description,
        ObjectNode area,
        List<String> fields,
        long created,
        long changed,
        long sequence) {

    static Domain of(String domain, DomainDetails details, long now, long sequence) {
        return new Domain(
                domain, details.name(), details.description(), details.area(), details.fields(), now, now, sequence);
    }

    Domain changed(DomainDetails change, long now, long newSequence) {
        DomainDetails all = change.over(new DomainDetails(name, description, area, fields));
        return new Domain(domain, all.name(), all.description(), all.area(), all.fields(), created, now, newSequence);
    }

    /** The same for readers who need no area, which is most of what a domain takes. */
    public Domain withoutArea() {
        return new Domain(domain, name, description, null, fields, created, changed, sequence);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
