/** What the managers share: requests once, answers once, what they write, the topics. */
package io.furrow.control.manager;
