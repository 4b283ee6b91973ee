"""Follow a link as a reader does: what is read next is read after the page has answered."""


def follow_link(tab, link: str) -> None:  # type: ignore[no-untyped-def]
    """Click; wait for the other page to be loaded or, for a link within the page, for its
    scripts to have heard of it.
    """
    target = tab.locator(link).evaluate("(a) => a.href")
    if tab.url.split("#")[0] != target.split("#")[0]:
        with tab.expect_navigation():
            tab.click(link)
    elif tab.url != target:  # the browser tells the scripts in a task of its own, after the click
        tab.evaluate(
            "() => { window.heard = new Promise((done) => addEventListener('hashchange', () =>"
            " done(), { once: true })); }"
        )
        tab.click(link)
        tab.evaluate("() => window.heard")
    else:
        tab.click(link)
