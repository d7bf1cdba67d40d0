package io.furrow.control.domain;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.DomainDetails;
import io.furrow.model.ngsi.StateJson;

/**
 * A domain as stored, and a record of {@code service.domains} keyed by its name. Members without a value are null.
 *
 * @param domain its name in topics
 * @param display name
 * @param area GeoJSON; owned by the domain
 * @param fields ids of fields
 * @param created when it was created, epoch ms
 * @param changed when it last changed, epoch ms
 * @param sequence increases with every change of the desired state
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

    /** Returns the domain without its area, its largest member. */
    public Domain withoutArea() {
        return new Domain(domain, name, description, null, fields, created, changed, sequence);
    }

    byte[] toBytes() {
        return StateJson.write(this);
    }
}
