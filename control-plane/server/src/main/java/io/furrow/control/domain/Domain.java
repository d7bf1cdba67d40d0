package io.furrow.control.domain;

import com.fasterxml.jackson.annotation.JsonUnwrapped;

import io.furrow.model.control.DomainDetails;
import io.furrow.model.ngsi.StateRecord;

/**
 * A domain as stored, and a record of {@code service.domains} keyed by its name. Members without a value are null.
 *
 * @param domain its name in topics
 * @param details owned by the domain
 * @param created when it was created, epoch ms
 * @param changed when it last changed, epoch ms
 * @param sequence increases with every change of the desired state
 */
public record Domain(String domain, @JsonUnwrapped DomainDetails details, long created, long changed, long sequence)
        implements StateRecord {
    static Domain of(String domain, DomainDetails details, long now, long sequence) {
        return new Domain(domain, details, now, now, sequence);
    }

    Domain with(DomainDetails newDetails, long now, long newSequence) {
        return new Domain(domain, newDetails, created, now, newSequence);
    }

    /** Returns the domain without its area, its largest member. */
    public Domain withoutArea() {
        DomainDetails rest = new DomainDetails(details.name(), details.description(), null, details.fields());
        return new Domain(domain, rest, created, changed, sequence);
    }
}
